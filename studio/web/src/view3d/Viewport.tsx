import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { dark } from "../app/settings";
import { length } from "../ui/format";
import { roundStep } from "./Ground";
import { View } from "./View";
import { viewNames, type Upright, type ViewName } from "./views";

export interface ViewportProps {
  /** What is seen, for those who do not see it. */
  label: string;
  /** Called once with the view; may return what is to be done at its end. */
  onReady(view: View): void | (() => void);
  up?: Upright;
  /** Buttons for the six views and "fit". */
  views?: boolean;
  /** Over the picture. */
  children?: ComponentChildren;
  testId?: string;
}

/**
 * A 3D view: drag rotates, the right button moves, the wheel zooms; with the focus arrows rotate, + and − zoom, 0 fits, and
 * 1 … 6 show top, bottom, front, back, left and right. Without WebGL it states this, and the rest of the page continues.
 */
export function Viewport({ label, onReady, up = "-y", views = true, children, testId }: ViewportProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const bar = useRef<HTMLDivElement>(null);
  const view = useRef<View | null>(null);
  const [missing, setMissing] = useState(false);

  useEffect(() => {
    let made: View;
    try {
      made = new View(canvas.current!, up);
    } catch {
      setMissing(true);
      return;
    }
    view.current = made;
    made.beforeDraw.add(() => showScale(bar.current, made));
    const end = onReady(made);
    made.invalidate();
    return () => {
      end?.();
      view.current = null;
      made.destroy();
    };
  }, [up]);
  useEffect(() => view.current?.takeColours(), [dark.value]);

  if (missing) {
    return (
      <div class="viewport" data-testid={testId}>
        <p class="viewport-message">
          This browser cannot show 3D views, because WebGL is missing or disabled. The rest of this page works; its values and plots are the same.
        </p>
      </div>
    );
  }
  return (
    <div class="viewport" data-testid={testId}>
      <canvas
        key={up} // one that has lost its context cannot have another
        ref={canvas}
        tabIndex={0}
        role="img"
        aria-label={`${label}. Keys: arrows rotate, plus and minus zoom, 0 fits, 1 to 6 choose a side.`}
        onKeyDown={(event) => {
          if (!view.current || event.ctrlKey || event.altKey || event.metaKey || !moved(view.current, event.key)) return;
          event.preventDefault();
          event.stopPropagation();
        }}
      />
      {views && (
        <div class="viewport-views" role="group" aria-label="Views">
          {viewNames.map((name) => (
            <button key={name} type="button" class="button" onClick={() => view.current?.setView(name)}>
              {name}
            </button>
          ))}
          <button type="button" class="button" onClick={() => view.current?.setView("home")}>
            fit
          </button>
        </div>
      )}
      <div ref={bar} class="viewport-scale" />
      {children}
    </div>
  );
}

const kTurn_rad = Math.PI / 24;

function moved(view: View, key: string): boolean {
  const side: ViewName | undefined = viewNames[Number(key) - 1];
  if (side) view.setView(side);
  else if (key === "ArrowLeft") view.orbit(-kTurn_rad, 0);
  else if (key === "ArrowRight") view.orbit(kTurn_rad, 0);
  else if (key === "ArrowUp") view.orbit(0, kTurn_rad);
  else if (key === "ArrowDown") view.orbit(0, -kTurn_rad);
  else if (key === "+" || key === "=") view.orbit(0, 0, 1 / 1.2);
  else if (key === "-") view.orbit(0, 0, 1.2);
  else if (key === "0") view.fit();
  else return false;
  return true;
}

/** A bar of a round length, true at the middle of the view. */
function showScale(bar: HTMLDivElement | null, view: View): void {
  if (!bar) return;
  const perPixel_m = view.metresPerPixel();
  const length_m = roundStep(120 * perPixel_m);
  bar.style.width = `${Math.round(length_m / perPixel_m)}px`;
  bar.textContent = length(length_m, 1);
}
