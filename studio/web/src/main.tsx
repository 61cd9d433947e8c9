import "./style/tokens.css";
import "./style/base.css";
import "./style/controls.css";
import "./style/data.css";
import "./style/shell.css";
import { render } from "preact";
import { followServer } from "./app/follow";
import { Shell } from "./app/Shell";
import { followSettings } from "./app/settings";
import { connect } from "./net/connection";
import { followKeys } from "./ui/keys";
import { complain } from "./ui/toast";

window.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  complain(event.reason);
});
window.addEventListener("error", (event) => {
  if (!event.error) return; // a ResizeObserver that will be heard a frame later
  event.preventDefault();
  complain(event.error);
});
followSettings();
followKeys(window);
followServer();
render(<Shell />, document.getElementById("app")!);
connect().catch(complain);
