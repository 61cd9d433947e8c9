// report.html: one file that shows results without a server (docs/report.md).
import { render } from "preact";
import "./report.css";

render(<main />, document.body);
