import { useEffect, useRef, useState } from "preact/hooks";
import { editToOpen, pageOf } from "../app/opened";
import { go } from "../app/go";
import { link } from "../net/connection";
import { edit, valueAt } from "../state/document";
import { attempt, Button } from "../ui/Button";
import { Dialog } from "../ui/Dialog";
import { entries } from "../ui/entries";
import { MeshInfoTable } from "../ui/MeshInfoPanel";
import { complain } from "../ui/toast";
import { add, added, adding, holdsHeights, isTable, stopAdding } from "./adding";
import { chosenFiles, droppedFiles } from "./dropped";
import { ImportDialog } from "./ImportDialog";
import { SurfaceDialog } from "./SurfaceDialog";
import "./add.css";

/** Files into the project's folder by button and by drop, and other programs' tables as recordings. */
export function AddFiles({ open, onClose, onOpen }: { open: boolean; onClose(): void; onOpen(): void }) {
  const [importing, setImporting] = useState<string | null>(null);
  const [looked, setLooked] = useState<string | null>(null);
  const [surface, setSurface] = useState<string | null>(null);
  const surfaces = entries.value.filter(({ kind }) => kind === "surface");
  const files = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  const over = useDrop(onOpen);
  const under = adding.value;
  const take = (input: HTMLInputElement) => {
    const choice = chosenFiles(input.files ?? []);
    input.value = "";
    void add(choice);
  };
  const show = async (kind: Parameters<typeof editToOpen>[0], name: string) => {
    const page = pageOf(kind)!;
    const change = editToOpen(kind, name, valueAt(`/${page}`));
    if (change) await edit(change.path, change.value, change.label);
    onClose();
    go(page);
  };
  return (
    <>
      {over && (
        <div class="add-over" aria-hidden="true">
          <p>Drop files or folders to add them to the project</p>
        </div>
      )}
      <Dialog open={open && importing === null && surface === null} title="Add files" onClose={onClose}>
        <p>
          Files are copied into the project's folder. Existing files are not replaced. Recordings are folders: add the whole folder. You can also drop files
          and folders anywhere on this window.
        </p>
        <div class="add-buttons">
          <Button kind="primary" disabled={!!under || link.value !== "open"} onClick={() => files.current!.click()} testId="add-choose-files">
            Choose files …
          </Button>
          <Button disabled={!!under || link.value !== "open"} onClick={() => folder.current!.click()} testId="add-choose-folder">
            Choose a folder …
          </Button>
          <Button kind="quiet" disabled={!!under} onClick={() => setImporting("")} testId="add-import">
            Import tables of another program …
          </Button>
        </div>
        <input ref={files} type="file" multiple hidden data-testid="add-files" onChange={(event) => take(event.currentTarget)} />
        <input ref={folder} type="file" hidden data-testid="add-folder" {...{ webkitdirectory: true }} onChange={(event) => take(event.currentTarget)} />
        {under && (
          <div class="add-progress" role="status">
            <progress value={under.fraction} max={1} aria-label="Files that are being added" />
            <span>
              {under.files} {under.files === 1 ? "file" : "files"}, {Math.round(100 * under.fraction)} %
            </span>
            <Button kind="quiet" onClick={stopAdding}>
              Cancel
            </Button>
          </div>
        )}
        {added.value.length > 0 && (
          <ul class="add-list" aria-label="Added" data-testid="added">
            {added.value.map(({ name }) => {
              const entry = entries.value.find((one) => one.name === name);
              return (
                <li key={name}>
                  <span>{name}</span>
                  {entry && pageOf(entry.kind) && (
                    <Button kind="quiet" label={`Open ${name}`} onClick={() => show(entry.kind, name)}>
                      Open
                    </Button>
                  )}
                  {entry?.kind === "mesh" && (
                    <Button kind="quiet" label={`Information on ${name}`} pressed={looked === name} onClick={() => setLooked(looked === name ? null : name)}>
                      Information
                    </Button>
                  )}
                  {holdsHeights(name) && (
                    <Button kind="quiet" label={`Heights of ${name}`} onClick={() => setSurface(name)}>
                      Heights
                    </Button>
                  )}
                  {isTable(name) && (
                    <Button kind="quiet" label={`Import ${name}`} onClick={() => setImporting(name)}>
                      Import …
                    </Button>
                  )}
                  {looked === name && (
                    <div class="add-info">
                      <MeshInfoTable file={name} />
                    </div>
                  )}
                </li>
              );
            })}
          </ul>
        )}
        {surfaces.length > 0 && (
          <>
            <h3>Surfaces in the project</h3>
            <ul class="add-list" aria-label="Surfaces" data-testid="surfaces">
              {surfaces.map(({ name }) => (
                <li key={name}>
                  <span>{name}</span>
                  <Button kind="quiet" label={`Heights of ${name}`} onClick={() => setSurface(name)}>
                    Heights
                  </Button>
                </li>
              ))}
            </ul>
          </>
        )}
      </Dialog>
      {surface !== null && <SurfaceDialog file={surface} onClose={() => setSurface(null)} />}
      {importing !== null && (
        <ImportDialog
          first={importing}
          onClose={() => setImporting(null)}
          onDone={(recording) => {
            setImporting(null);
            void attempt(() => show("recording", recording));
          }}
        />
      )}
    </>
  );
}

/** Takes files that are dropped anywhere; true while some are held over the window. */
function useDrop(onDrop: () => void): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    let depth = 0;
    const hasFiles = (event: DragEvent) => !!event.dataTransfer?.types.includes("Files");
    const enter = (event: DragEvent) => hasFiles(event) && (++depth, setOver(true));
    const leave = (event: DragEvent) => hasFiles(event) && (depth = Math.max(0, depth - 1)) === 0 && setOver(false);
    const hold = (event: DragEvent) => hasFiles(event) && event.preventDefault();
    const drop = (event: DragEvent) => {
      depth = 0;
      setOver(false);
      if (!hasFiles(event)) return;
      event.preventDefault();
      onDrop();
      droppedFiles(event.dataTransfer!).then(add).catch(complain);
    };
    addEventListener("dragenter", enter);
    addEventListener("dragleave", leave);
    addEventListener("dragover", hold);
    addEventListener("drop", drop);
    return () => {
      removeEventListener("dragenter", enter);
      removeEventListener("dragleave", leave);
      removeEventListener("dragover", hold);
      removeEventListener("drop", drop);
    };
  }, []);
  return over;
}
