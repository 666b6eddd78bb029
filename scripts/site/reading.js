// What scrolls by itself, a wide table or a long command, is reached and moved by the keyboard.
addEventListener("load", () => {
  const mark = () => {
    for (const box of document.querySelectorAll(".md-typeset__scrollwrap, .md-typeset pre > code, .equation")) {
      if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
      else box.removeAttribute("tabindex");
    }
  };
  mark();
  // The theme's search is a dialog without a name, and its list scrolls.
  document.querySelector(".md-search")?.setAttribute("aria-label", "Search");
  document.querySelector(".md-search__scrollwrap")?.setAttribute("tabindex", "0");
  addEventListener("resize", mark);
});
