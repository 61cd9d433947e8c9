import { Icon } from "./Icon";
import { dismiss, toasts } from "./toast";

/** The messages of say() and complain(). In the page once. */
export function Toasts() {
  return (
    <div class="toasts" role="status" aria-live="polite">
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
