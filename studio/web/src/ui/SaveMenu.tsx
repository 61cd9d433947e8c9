import { useEffect, useRef, useState } from "preact/hooks";
import { attempt } from "./Button";
import { IconButton } from "./IconButton";

export interface SaveMenuProps {
  /** What is saved; read out. */
  what: string;
  choices: readonly { words: string; run(): unknown }[];
  testId?: string;
}

/** A button that opens a list of ways to keep something; Escape and a click elsewhere close it. */
export function SaveMenu({ what, choices, testId }: SaveMenuProps) {
  const [open, setOpen] = useState(false);
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!open) return;
    place.current?.querySelector<HTMLButtonElement>("[role=menuitem]")?.focus();
    const elsewhere = (event: Event) => !place.current?.contains(event.target as Node) && setOpen(false);
    addEventListener("pointerdown", elsewhere);
    return () => removeEventListener("pointerdown", elsewhere);
  }, [open]);
  const close = () => {
    setOpen(false);
    place.current?.querySelector<HTMLButtonElement>("button")?.focus();
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === "Escape") {
      event.stopPropagation();
      return close();
    }
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    const items = [...place.current!.querySelectorAll<HTMLButtonElement>("[role=menuitem]")];
    const next = items.indexOf(document.activeElement as HTMLButtonElement) + (event.key === "ArrowDown" ? 1 : -1);
    items[(next + items.length) % items.length]?.focus();
  };
  return (
    <div class="save-menu" ref={place} data-testid={testId} onKeyDown={open ? key : undefined}>
      <IconButton icon="download" label={`Save or copy ${what}`} pressed={open} onClick={() => setOpen(!open)} />
      {open && (
        <div role="menu" aria-label={`Save or copy ${what}`}>
          {choices.map(({ words, run }) => (
            <button
              key={words}
              type="button"
              role="menuitem"
              onClick={() => {
                close();
                void attempt(run);
              }}
            >
              {words}
            </button>
          ))}
        </div>
      )}
    </div>
  );
}
