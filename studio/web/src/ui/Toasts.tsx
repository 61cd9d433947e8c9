import { useEffect, useRef } from "preact/hooks";
import { Icon } from "./Icon";
import { dismiss, toasts } from "./toast";

/** The messages of say() and complain(), at the foot of a column of the page, which makes room. In the page once. */
export function Toasts() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const observer = new ResizeObserver(() => makeRoom(place.current?.offsetHeight ?? 0));
    observer.observe(place.current!);
    return () => observer.disconnect();
  }, []);
  return (
    <div ref={place} class="toasts" role="status" aria-live="polite">
      {toasts.value.map((toast) => (
        <div key={toast.id} class={`toast toast-${toast.kind}`} data-testid={`toast-${toast.kind}`}>
          <div>
            <p class="toast-message">
              {toast.kind === "error" && <span class="toast-word">Error: </span>}
              {toast.message}
            </p>
            {toast.hint && <p class="toast-hint">{toast.hint}</p>}
          </div>
          <button type="button" class="button button-icon" aria-label="Close this message" onClick={() => dismiss(toast.id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}

function makeRoom(height_px: number): void {
  document.documentElement.style.setProperty("--toasts-height", height_px > 0 ? `calc(${height_px}px + var(--space-2))` : "0px");
}
