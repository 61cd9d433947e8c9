import { useEffect, useRef, useState } from "preact/hooks";
import { AddFiles } from "../add/AddFiles";
import { adding, adds } from "../add/adding";
import { link } from "../net/connection";
import { ForceStatus } from "../pages/feel/ForceStatus";
import { about } from "../state/about";
import { redo, redoLabel, undo, undoLabel } from "../state/document";
import { Button } from "../ui/Button";
import { IconButton } from "../ui/IconButton";
import { useKeys } from "../ui/keys";
import { Lamp, type LampState } from "../ui/Lamp";
import { Toasts } from "../ui/Toasts";
import { helpPage } from "../ui/helpPage";
import { Help } from "./Help";
import { JobBar } from "./JobBar";
import { PageFrame } from "./PageFrame";
import { Palette } from "./Palette";
import { Rescued } from "./Rescued";
import { go } from "./go";
import { route, routes } from "./routes";
import { Sessions } from "./Sessions";
import { nextTheme, theme } from "./settings";
import { WaitingKey } from "./WaitingKey";

const LINKS: Record<string, [LampState, string]> = {
  connecting: ["busy", "connecting"],
  open: ["good", "connected"],
  lost: ["bad", "no connection"],
  refused: ["bad", "not admitted"],
};

/** Header, page and messages. */
export function Shell() {
  const [help, setHelp] = useState(false);
  const [sessions, setSessions] = useState(false);
  const [palette, setPalette] = useState(false);
  useKeys(
    [
      { key: "ctrl+z", label: "undo", run: () => undoLabel.value && undo() },
      { key: "ctrl+shift+z", label: "redo", run: () => redoLabel.value && redo() },
      { key: "o", label: "add files", run: () => (adds.value = true) },
      { key: "ctrl+k", label: "find a page, an action, a file or a document", always: true, run: () => setPalette(true) },
      { key: "?", label: "show the keys", run: () => setHelp(true) },
      ...routes.map(({ id, title, key }) => ({ key: `g ${key}`, label: `go to ${title}`, run: () => go(id) })),
    ],
    "Everywhere",
  );
  useFocusOnPage();
  useEffect(() => void (helpPage.value = route.value.help ?? "studio.html"), [route.value.id]);
  const [lamp, word] = LINKS[link.value]!;
  return (
    <div class="shell">
      <a class="skip-link" href="#main" onClick={skipToPage}>
        Skip to the page
      </a>
      <header class="shell-header">
        <span class="shell-name">Asperity</span>
        <nav aria-label="Pages" class="shell-nav">
          {routes.map(({ id, title }) => (
            <a key={id} href={`#/${id}`} aria-current={route.value.id === id ? "page" : undefined}>
              {title}
            </a>
          ))}
        </nav>
        <div class="shell-force">
          <ForceStatus />
        </div>
        <div class="shell-tools">
          <IconButton icon="plus" label={adding.value ? "Files are being added" : "Add files"} onClick={() => (adds.value = true)} testId="add" />
          <IconButton icon="find" label="Find (Ctrl K)" onClick={() => setPalette(true)} testId="find" />
          <UndoButton icon="undo" word="Undo" of={undoLabel.value} onClick={undo} />
          <UndoButton icon="redo" word="Redo" of={redoLabel.value} onClick={redo} />
          <IconButton icon={theme.value} label={`Theme: ${theme.value}`} onClick={nextTheme} testId="theme" />
          <IconButton icon="help" label="Help and keys" onClick={() => setHelp(true)} testId="help" />
          <Lamp state={lamp} word={word} label="Server:" live testId="link" />
        </div>
      </header>
      {(link.value === "lost" || link.value === "refused") && (
        <p class="shell-banner" role="alert">
          {link.value === "lost"
            ? "The studio's server does not answer. Nothing is lost. The page continues when the server answers again. If you restart the server, open the address that it prints."
            : "The server does not know this browser. Open the address that asperity studio printed last. Your choices are kept."}
        </p>
      )}
      <Rescued />
      <main id="main" class="shell-main" tabIndex={-1} inert={link.value === "lost" || link.value === "refused"}>
        <PageFrame key={route.value.id} route={route.value} />
      </main>
      <footer class="shell-footer">
        <JobBar />
        {about.value && (
          <span class="shell-folder">
            Folder {about.value.folder}, version {about.value.version}
          </span>
        )}
        <Button kind="quiet" onClick={() => setSessions(true)} disabled={link.value !== "open"} testId="show-sessions">
          Sessions
        </Button>
      </footer>
      <Toasts />
      <WaitingKey />
      <AddFiles open={adds.value} onClose={() => (adds.value = false)} onOpen={() => (adds.value = true)} />
      <Palette open={palette} onClose={() => setPalette(false)} />
      <Help open={help} onClose={() => setHelp(false)} />
      <Sessions open={sessions} onClose={() => setSessions(false)} />
    </div>
  );
}

function UndoButton({ icon, word, of, onClick }: { icon: "undo" | "redo"; word: string; of: string; onClick(): unknown }) {
  const label = of ? `${word}: ${of}` : `Nothing to ${icon}`;
  return <IconButton icon={icon} label={label} disabled={!of || link.value !== "open"} onClick={onClick} testId={icon} />;
}

/** Where the page's change has taken the focus away, the next Tab goes into the new page. */
function useFocusOnPage(): void {
  const first = useRef(true);
  useEffect(() => {
    if (!first.current && document.activeElement === document.body) document.getElementById("main")?.focus();
    first.current = false;
  }, [route.value.id]);
}

function skipToPage(event: Event): void {
  event.preventDefault();
  document.getElementById("main")?.focus();
}
