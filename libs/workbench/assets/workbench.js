document.getElementById("workbench").textContent = "The page of the workbench has not been built: make web";
