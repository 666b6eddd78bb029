// Search in a site that is opened from a folder: there browsers forbid fetching the index that the theme's own search uses, so it
// comes as a script (search/search_index.js), and what holds all the words is listed, titles first.
if (location.protocol === "file:") {
  const base = document.currentScript.dataset.base;
  window.__search = { index: new Promise(() => {}) };  // the theme's own search waits for ever
  const load = () => {
    if (window.herseyIndex !== undefined) return Promise.resolve();
    return new Promise((done) => {
      const script = document.createElement("script");
      script.src = `${base}/search/search_index.js`;
      script.onload = done;
      document.head.append(script);
    });
  };
  const find = (query) => {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    const weight = (doc) => {
      const title = doc.title.toLowerCase(), text = doc.text.toLowerCase();
      if (!words.every((word) => title.includes(word) || text.includes(word))) return 0;
      return words.reduce((sum, word) => sum + (title.includes(word) ? 10 : 1), 0) + (doc.location.includes("#") ? 0 : 1);
    };
    const found = window.herseyIndex.docs.map((doc) => ({ doc, weight: weight(doc) })).filter((entry) => entry.weight > 0);
    return words.length ? found.sort((a, b) => b.weight - a.weight).slice(0, 30).map((entry) => entry.doc) : [];
  };
  const show = (docs, list, meta) => {
    meta.textContent = docs.length ? `${docs.length} found` : "nothing found";
    list.replaceChildren(...docs.map((doc) => {
      const item = document.createElement("li"), link = document.createElement("a"), article = document.createElement("article"), title = document.createElement("h2");
      item.className = "md-search-result__item";
      link.className = "md-search-result__link";
      link.href = `${base}/${doc.location}`;
      article.className = "md-search-result__article md-typeset";
      title.className = "md-search-result__title";
      title.textContent = doc.title;
      article.append(title, `${doc.text.replace(/<[^>]*>/g, "").slice(0, 120)}`);
      link.append(article);
      item.append(link);
      return item;
    }));
  };
  // The theme hides a search that it cannot do.
  addEventListener("load", () => {
    for (const part of document.querySelectorAll("[data-md-component=search], label[for=__search]")) part.hidden = false;
  });
  document.addEventListener("DOMContentLoaded", () => {
    const input = document.querySelector("[data-md-component=search-query]");
    const opener = document.getElementById("__search");
    input.addEventListener("focus", () => { opener.checked = true; });
    input.addEventListener("keydown", ({ key }) => { if (key === "Escape") { opener.checked = false; input.blur(); } });
    input.addEventListener("input", async () => {
      await load();
      show(find(input.value), document.querySelector(".md-search-result__list"), document.querySelector(".md-search-result__meta"));
    });
  });
}
