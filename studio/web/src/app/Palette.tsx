import { useRef, useState } from "preact/hooks";
import { attempt } from "../ui/Button";
import { Dialog } from "../ui/Dialog";
import { entries } from "../ui/entries";
import { documentAddress } from "../ui/helpPage";
import { keyGroups } from "../ui/keys";
import { openEntry } from "./openEntry";
import { pageOf } from "./opened";
import { documents } from "./documents";
import { found, type Command } from "./palette";

/** Finds pages, actions, files and documents by their names. */
export function Palette({ open, onClose }: { open: boolean; onClose(): void }) {
  return (
    <Dialog open={open} title="Find" onClose={onClose}>
      {open && <Search onClose={onClose} />}
    </Dialog>
  );
}

function Search({ onClose }: { onClose(): void }) {
  const [typed, setTyped] = useState("");
  const [at, setAt] = useState(0);
  const list = useRef<HTMLUListElement>(null);
  const shown = found(commands(), typed);
  const chosen = Math.min(at, shown.length - 1);
  const run = (command: Command | undefined) => {
    if (!command) return;
    onClose();
    void attempt(command.run);
  };
  const onKey = (event: KeyboardEvent) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && shown.length > 0) setAt((chosen + step + shown.length) % shown.length);
    else if (event.key === "Enter") run(shown[chosen]);
    else return;
    event.preventDefault();
  };
  return (
    <>
      <input
        class="palette-input"
        type="text"
        role="combobox"
        aria-label="Find a page, an action, a file or a document"
        aria-expanded="true"
        aria-controls="palette-list"
        aria-activedescendant={chosen >= 0 ? `palette-${chosen}` : undefined}
        placeholder="Page, action, file or document"
        autocomplete="off"
        value={typed}
        ref={(input) => input?.focus()}
        onInput={(event) => {
          setTyped(event.currentTarget.value);
          setAt(0);
        }}
        onKeyDown={onKey}
        data-testid="palette-input"
      />
      <ul id="palette-list" class="palette-list" role="listbox" aria-label="Found" ref={list}>
        {shown.map((command, index) => (
          <li key={`${command.kind} ${command.title}`} id={`palette-${index}`} role="option" aria-selected={index === chosen} onClick={() => run(command)} onPointerMove={() => setAt(index)}>
            <span class="palette-kind">{command.kind}</span>
            <span class="palette-title">{command.title}</span>
            {command.key && <kbd>{command.key}</kbd>}
          </li>
        ))}
      </ul>
      {shown.length === 0 && <p role="status">Nothing has this name.</p>}
    </>
  );
}

function commands(): Command[] {
  const sentence = (label: string) => label.charAt(0).toUpperCase() + label.slice(1);
  const actions = keyGroups.value.flatMap(({ keys }) => keys.map(({ key, label, run }): Command => ({ title: sentence(label), kind: "Action", key, run })));
  const files = entries.value
    .filter(({ kind }) => pageOf(kind))
    .map(({ kind, name }): Command => ({ title: name, kind: "File", run: () => openEntry(kind, name) }));
  const pages = documents.map(({ page, title }): Command => ({ title, kind: "Document", run: () => void window.open(documentAddress(page), "_blank", "noopener") }));
  return [...actions, ...files, ...pages];
}
