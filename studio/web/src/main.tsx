import "./style/tokens.css";
import "./style/base.css";
import "./style/controls.css";
import "./style/data.css";
import "./style/shell.css";
import { effect } from "@preact/signals";
import { render } from "preact";
import { Shell } from "./app/Shell";
import { followSettings } from "./app/settings";
import { connect, link } from "./net/connection";
import { followDocument, readDocument } from "./state/document";
import { followEntries, readEntries } from "./ui/entries";
import { followJobs, forgetJobs } from "./ui/job";
import { followKeys } from "./ui/keys";
import { complain } from "./ui/toast";

followDocument();
followJobs();
followEntries();
followSettings();
followKeys(window);
effect(() => {
  if (link.value !== "open") return;
  forgetJobs();
  readDocument().catch(complain);
  void readEntries();
});
window.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  complain(event.reason);
});
window.addEventListener("error", (event) => {
  event.preventDefault();
  complain(event.error ?? event.message);
});

render(<Shell />, document.getElementById("app")!);
connect().catch(complain);
