import { useEffect, useState } from "preact/hooks";
import { adds } from "../../add/adding";
import { go } from "../../app/go";
import { guided } from "../../app/guide";
import { openEntry } from "../../app/openEntry";
import { pageOf } from "../../app/opened";
import { call, link } from "../../net/connection";
import { copyText } from "../../save/files";
import { about } from "../../state/about";
import { edit, valueAt } from "../../state/document";
import { Button } from "../../ui/Button";
import { entries, readEntries } from "../../ui/entries";
import { documentAddress } from "../../ui/helpPage";
import { complain, say } from "../../ui/toast";
import { counts } from "./counts";
import { ProjectSettings } from "./ProjectSettings";
import "./home.css";

interface Recent {
  folder: string;
  opened: string;
}

const READING = [
  { page: "start/first-texture.html", title: "Your first texture in ten minutes" },
  { page: "tutorials/own-data.html", title: "Your own data" },
  { page: "studio.html", title: "The studio" },
  { page: "glossary.html", title: "Glossary" },
  { page: "troubleshooting.html", title: "Troubleshooting" },
];
const kMostOpened = 6;

/** What a newcomer sees first, and where one who comes again continues. */
export default function HomePage() {
  const [recent, setRecent] = useState<Recent[]>([]);
  useEffect(() => {
    if (link.value === "open") call<Recent[]>("home.recent").then(setRecent, complain);
  }, [link.value]);
  return (
    <div class="home">
      <h1>Measure a surface, make a haptic texture of it, touch it</h1>
      <p>
        The studio works in the folder <strong>{about.value?.folder}</strong>. Everything that it makes is stored there, in the files that the command line writes too.
      </p>
      <div class="home-ways">
        <Way title="Try the virtual bench" words="No hardware is needed: a simulated hand scans a surface, and a guide leads you through the first scan. About a minute.">
          <Button kind="primary" onClick={tryBench} testId="home-bench">
            Start the guided scan
          </Button>
        </Way>
        <Way title="Open the sample project" words="Three simulated scans with their textures, and the profile of a real surface by a stylus instrument. They are put into the folder “sample” within seconds.">
          <Button kind="primary" onClick={openSample} testId="home-sample">
            Add the sample project
          </Button>
        </Way>
        <Way title="Add your files" words="Recordings, 3D meshes, textures, and tables of other programs. They are copied into the folder.">
          <Button kind="primary" onClick={() => (adds.value = true)} testId="home-add">
            Add files …
          </Button>
        </Way>
      </div>
      <div class="home-lists">
        <section aria-labelledby="home-here">
          <h2 id="home-here">In this folder</h2>
          <InThisFolder />
        </section>
        <div>
          <section aria-labelledby="home-read">
            <h2 id="home-read">Read</h2>
            <ul>
              {READING.map(({ page, title }) => (
                <li key={page}>
                  <a href={documentAddress(page)} target="_blank" rel="noopener">
                    {title}
                  </a>
                </li>
              ))}
            </ul>
            <p class="field-hint">
              <kbd>Ctrl</kbd> <kbd>K</kbd> finds every page, file and action. <kbd>?</kbd> shows the keys.
            </p>
          </section>
        </div>
        <div>
          <section aria-labelledby="home-project">
            <h2 id="home-project">Project settings</h2>
            <ProjectSettings />
          </section>
          <section aria-labelledby="home-recent">
            <h2 id="home-recent">Recent projects</h2>
            {recent.length === 0 && <p class="empty">No other projects yet.</p>}
            <ul data-testid="home-recent">
              {recent.map(({ folder, opened }) => (
                <li key={folder}>
                  <span class="home-path" title={folder}>
                    {folder}
                  </span>
                  <span class="home-date">{opened.slice(0, 10)}</span>
                  <Button kind="quiet" label={`Copy the command that opens ${folder}`} onClick={() => copyCommand(folder)}>
                    Copy command
                  </Button>
                </li>
              ))}
            </ul>
            {recent.length > 0 && <p class="field-hint">A studio works in one folder. Enter the copied command in a terminal to open another.</p>}
          </section>
        </div>
      </div>
    </div>
  );
}

function Way({ title, words, children }: { title: string; words: string; children: preact.ComponentChildren }) {
  return (
    <section class="panel home-way">
      <h2>{title}</h2>
      <p>{words}</p>
      {children}
    </section>
  );
}

function InThisFolder() {
  const all = entries.value;
  const openable = all.filter(({ kind }) => pageOf(kind));
  if (all.length === 0) return <p class="empty">The folder is empty. Begin with one of the three ways above.</p>;
  return (
    <>
      <p>{counts(all)}</p>
      <ul data-testid="home-here">
        {openable.slice(0, kMostOpened).map(({ kind, name }) => (
          <li key={name}>
            <span class="home-path" title={name}>
              {name}
            </span>
            <Button kind="quiet" label={`Open ${name}`} onClick={() => openEntry(kind, name)}>
              Open in {pageOf(kind)!.replace(/^./, (first) => first.toUpperCase())}
            </Button>
          </li>
        ))}
      </ul>
      {openable.length > kMostOpened && <p class="field-hint">{openable.length - kMostOpened} more: press Ctrl K and type a name.</p>}
    </>
  );
}

async function tryBench(): Promise<void> {
  if ((valueAt("/scan/source") as string) !== "bench") await edit("/scan/source", "bench", "choose the source");
  guided.value = true;
  go("scan");
}

async function openSample(): Promise<void> {
  const { folder, recording } = await call<{ folder: string; recording: string }>("home.sample");
  await readEntries();
  say(`The sample project is in the folder ${folder}.`, "Its README.txt states what each file is.");
  await openEntry("recording", recording);
}

async function copyCommand(folder: string): Promise<void> {
  await copyText(`asperity studio ${/^[\w./-]+$/.test(folder) ? folder : `'${folder.replaceAll("'", `'\\''`)}'`}`);
  say("The command is on the clipboard.");
}
