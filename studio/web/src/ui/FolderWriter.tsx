import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { Button } from "./Button";
import { readEntries } from "./entries";
import { TextField } from "./TextField";
import { Toggle } from "./Toggle";

export interface FolderWriterProps<Written> {
  /** The name that is proposed for the folder. */
  folder: string;
  button: string;
  hint: string;
  disabled?: boolean;
  /** Writes into the folder; what it returns is shown. */
  write(name: string, replace: boolean): Promise<Written>;
  /** What is shown below the button once something is written. */
  children(written: Written): ComponentChildren;
  buttonTestId: string;
  /** The files that are shown. */
  testId: string;
}

/** Writes a result into a folder of the project: its name, whether it replaces what has this name, the button, the outcome. */
export function FolderWriter<Written>({ folder, button, hint, disabled, write, children, buttonTestId, testId }: FolderWriterProps<Written>) {
  const [name, setName] = useState(folder);
  const [replace, setReplace] = useState(false);
  const [written, setWritten] = useState<Written | null>(null);
  const onClick = async () => {
    setWritten(null);
    setWritten(await write(name, replace));
    setReplace(false);
    await readEntries();
  };
  return (
    <>
      <TextField label="Folder" value={name} onInput={setName} onChange={setName} />
      <Toggle label="Replace an existing folder" on={replace} onChange={setReplace} />
      <Button kind="primary" onClick={onClick} disabled={name === "" || disabled} hint={hint} testId={buttonTestId}>
        {button}
      </Button>
      <div role="status" class="folder-written" data-testid={testId}>
        {written && children(written)}
      </div>
    </>
  );
}
