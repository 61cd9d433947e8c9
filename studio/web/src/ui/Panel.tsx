import type { ComponentChildren } from "preact";
import { useId, useState } from "preact/hooks";
import { documentAddress, helpPage } from "./helpPage";
import { Icon } from "./Icon";

export interface PanelProps {
  title: string;
  children: ComponentChildren;
  /** Buttons at the right of the title. */
  actions?: ComponentChildren;
  collapsible?: boolean;
  /** Of a collapsible one, at first. */
  open?: boolean;
  /** Uses the height that is left, and scrolls inside. */
  grow?: boolean;
  testId?: string;
}

/** A section with a title. */
export function Panel({ title, children, actions, collapsible = false, open = true, grow, testId }: PanelProps) {
  const id = useId();
  const [shown, setShown] = useState(open);
  return (
    <section class={grow ? "panel panel-grow" : "panel"} aria-labelledby={id} data-testid={testId}>
      <header class="panel-header">
        <h2 id={id}>
          {collapsible ? (
            <button type="button" class="panel-fold" aria-expanded={shown} onClick={() => setShown(!shown)}>
              <Icon name={shown ? "up" : "down"} />
              {title}
            </button>
          ) : (
            title
          )}
        </h2>
        <div class="panel-actions">
          {actions}
          {helpPage.value && (
            <a class="panel-help" href={documentAddress(helpPage.value, title)} target="_blank" rel="noopener" aria-label={`Help: ${title}`} title={`Help: ${title}`}>
              ?
            </a>
          )}
        </div>
      </header>
      {(shown || !collapsible) && <div class="panel-body">{children}</div>}
    </section>
  );
}
