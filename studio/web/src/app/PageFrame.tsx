import type { ComponentType } from "preact";
import { useEffect, useErrorBoundary, useState } from "preact/hooks";
import { documentIsRead } from "../state/document";
import { Button } from "../ui/Button";
import type { Route } from "./routes";

/** The page of a route, its code loaded when it is first needed; shown when the document has been read. */
export function PageFrame({ route }: { route: Route }) {
  const [page, setPage] = useState<{ id: string; Page: ComponentType } | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  const [broken, mend] = useErrorBoundary();

  const load = () => {
    setFault(null);
    route.load().then(
      (module) => setPage({ id: route.id, Page: module.default }),
      () => setFault("The page's code could not be loaded."),
    );
  };
  useEffect(load, [route.id]);

  if (broken) {
    const words = `The page has failed: ${broken instanceof Error ? broken.message : String(broken)}`;
    return <Failure title={route.title} words={words} again={mend} />;
  }
  if (fault) return <Failure title={route.title} words={fault} again={load} />;
  if (page?.id !== route.id || !documentIsRead.value) return <p class="page-wait">Loading {route.title} …</p>;
  return <page.Page key={page.id} />;
}

function Failure({ title, words, again }: { title: string; words: string; again(): void }) {
  return (
    <div class="page-empty" role="alert">
      <h1>{title}</h1>
      <p>{words}</p>
      <p>The server has kept your choices; nothing is lost.</p>
      <Button onClick={again}>Try again</Button>
    </div>
  );
}
