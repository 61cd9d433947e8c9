// Files that a person chose or dropped, with their paths below the folder that was dropped.

export interface Dropped {
  path: string;
  file: Blob;
}

export interface Choice {
  files: Dropped[];
  /** Hidden ones, which are not added. */
  hidden: number;
}

const isHidden = (path: string): boolean => path.split("/").some((part) => part.startsWith("."));

function sorted(files: Dropped[]): Choice {
  const shown = files.filter(({ path }) => !isHidden(path));
  shown.sort((a, b) => (a.path < b.path ? -1 : a.path > b.path ? 1 : 0));
  return { files: shown, hidden: files.length - shown.length };
}

/** Of an input for files, or for a folder, whose files have paths. */
export const chosenFiles = (list: Iterable<File>): Choice => sorted([...list].map((file) => ({ path: file.webkitRelativePath || file.name, file })));

/** Of a drop; folders are read to their ends. To be called while the drop is handled: later its items are gone. */
export async function droppedFiles(data: DataTransfer): Promise<Choice> {
  const roots: FileSystemEntry[] = [];
  const files: Dropped[] = [];
  for (const item of [...data.items].filter(({ kind }) => kind === "file")) {
    const entry = item.webkitGetAsEntry();
    // What comes from no folder, such as a picture of another page, has no entry.
    const file = entry ? null : item.getAsFile();
    if (entry) roots.push(entry);
    if (file) files.push({ path: file.name, file });
  }
  for (const root of roots) await collect(root, root.name, files);
  return sorted(files);
}

async function collect(entry: FileSystemEntry, path: string, files: Dropped[]): Promise<void> {
  if (entry.isFile) {
    files.push({ path, file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)) });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader hands out a hundred at a time.
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return;
    for (const inner of some) await collect(inner, `${path}/${inner.name}`, files);
  }
}
