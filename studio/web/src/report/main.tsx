// report.html: results in one file that needs no server (docs/report.md).
import "../style/tokens.css";
import "../style/base.css";
import "../style/controls.css";
import "../style/data.css";
import "./report.css";
import { render } from "preact";
import { dark } from "../app/settings";
import { Report } from "./Report";
import { resultsOf } from "./result";

/** Light on paper; else as the system has it. */
function followSystem(): void {
  const wantsDark = matchMedia("(prefers-color-scheme: dark)");
  const printing = matchMedia("print");
  const apply = () => {
    dark.value = wantsDark.matches && !printing.matches;
    document.documentElement.dataset.theme = dark.value ? "dark" : "light";
  };
  wantsDark.addEventListener("change", apply);
  printing.addEventListener("change", apply);
  apply();
}

followSystem();
const place = document.getElementById("report")!;
place.replaceChildren();
try {
  render(<Report results={resultsOf(document)} />, place);
} catch (error) {
  place.textContent = `This report is damaged: ${error instanceof Error ? error.message : error}. Make it again: asperity report FOLDER`;
}
