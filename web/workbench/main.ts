import "uplot/dist/uPlot.min.css";
import "../src/style.css";
import "./style.css";

import { Api, Refused, type Hello } from "./api";
import { h } from "../src/dom";
import { followSystem, setTheme } from "../src/theme";
import { texts } from "./texts";
import { Workbench } from "./workbench";

/** Once the folder is shown. */
let shown: Workbench | null = null;

/** The token comes in the address, where no server sees it, and leaves it at once. */
function takeToken(): string {
  const found = /(?:^#|&)token=([^&]+)/.exec(location.hash);
  if (found) {
    sessionStorage.setItem("hersey-token", found[1]!);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem("hersey-token") ?? "";
}

function askToken(page: HTMLElement, words: string): void {
  const field = h("input", { type: "text", id: "token", autocomplete: "off", spellcheck: "false" });
  const form = h("form", { class: "token-form" }, h("h1", {}, texts.name), h("p", {}, words), h("label", { for: "token" }, texts.token), field, h("button", { type: "submit", class: "main-button" }, texts.tokenGo));
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    sessionStorage.setItem("hersey-token", field.value.replace(/^.*token=/, "").trim());
    void start();
  });
  page.replaceChildren(h("main", { class: "token-page" }, form));
  field.focus();
}

async function start(): Promise<void> {
  const page = document.getElementById("workbench")!;
  const token = takeToken();
  if (!token) return askToken(page, texts.needToken);
  const api = new Api(token);
  let hello: Hello;
  try {
    hello = await api.get<Hello>("/api/hello");
  } catch (error) {
    if (error instanceof Refused && error.status === 401) return askToken(page, texts.tokenRefused);
    page.replaceChildren(h("main", { class: "token-page" }, h("p", { class: "fault" }, error instanceof Refused ? error.message : texts.unreachable)));
    return;
  }
  shown = new Workbench(api, hello);
  page.replaceChildren(shown.element);
  await shown.begin();
}

// The address of a program started anew at the same port differs in this alone: the browser stays at the page.
addEventListener("hashchange", () => {
  if (!/token=/.test(location.hash)) return;
  shown?.leave();
  location.reload();
});
followSystem();
const chosen = localStorage.getItem("hersey-theme");
if (chosen === "light" || chosen === "dark") setTheme(chosen);
void start();
