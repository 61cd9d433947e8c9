import { Dialog } from "../ui/Dialog";
import { documentAddress } from "../ui/helpPage";
import { keyGroups } from "../ui/keys";
import { route } from "./routes";

/** What the page is for, and its keys. */
export function Help({ open, onClose }: { open: boolean; onClose(): void }) {
  return (
    <Dialog open={open} title={`Help: ${route.value.title}`} onClose={onClose}>
      <p>{route.value.purpose}</p>
      <p>
        <a href={documentAddress(route.value.help ?? "studio.html")} target="_blank" rel="noopener" data-testid="help-document">
          The page {route.value.title} in the documents
        </a>
        {" · "}
        <a href={documentAddress("start/first-texture.html")} target="_blank" rel="noopener">
          Your first texture
        </a>
        {" · "}
        <a href={documentAddress("glossary.html")} target="_blank" rel="noopener">
          Glossary
        </a>
        {" · "}
        <a href={documentAddress("troubleshooting.html")} target="_blank" rel="noopener">
          Troubleshooting
        </a>
      </p>
      <p class="help-general">
        Tab goes to the next control. In a plot that has the focus <kbd>+</kbd> <kbd>−</kbd> zoom, <kbd>←</kbd> <kbd>→</kbd> move and <kbd>0</kbd> shows
        all; dragging zooms, and a double click shows all. In a 3D view the arrows rotate, <kbd>+</kbd> <kbd>−</kbd> zoom, <kbd>0</kbd> fits and <kbd>1</kbd>{" "}
        to <kbd>6</kbd> choose a side.
      </p>
      {keyGroups.value.map((group, index) => (
        <section key={index} class="help-keys">
          <h3>{group.title}</h3>
          <dl>
            {group.keys.map((key) => (
              <div key={key.key}>
                <dt>
                  {keyCaps(key.key).map((cap, at) => (
                    <kbd key={at}>{cap}</kbd>
                  ))}
                </dt>
                <dd>{key.label}</dd>
              </div>
            ))}
          </dl>
        </section>
      ))}
    </Dialog>
  );
}

const NAMES: Record<string, string> = {
  arrowup: "↑",
  arrowdown: "↓",
  arrowleft: "←",
  arrowright: "→",
  escape: "Esc",
  space: "Space",
  enter: "Enter",
  delete: "Del",
  ctrl: "Ctrl",
  shift: "Shift",
  alt: "Alt",
};

/** "ctrl+z" as Ctrl, Z. */
function keyCaps(key: string): string[] {
  return key
    .split(/[ ]|(?<=.)\+(?=.)/)
    .map((part) => NAMES[part] ?? (part.length === 1 ? part.toUpperCase() : part.charAt(0).toUpperCase() + part.slice(1)));
}
