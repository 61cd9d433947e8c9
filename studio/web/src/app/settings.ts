// How the app looks in this browser: the theme. Kept by the browser, as it belongs to the screen and not to the project.
import { effect, signal } from "@preact/signals";

export type Theme = "light" | "dark" | "system";

const kKey = "asperity.theme";
const themes: Theme[] = ["system", "light", "dark"];

export const theme = signal<Theme>("system");
/** True where the colours are those of the dark theme; plots and 3D views read their colours again when it changes. */
export const dark = signal(false);

export const nextTheme = (): void => void (theme.value = themes[(themes.indexOf(theme.value) + 1) % themes.length]!);

/** Applies the theme, now and when it or the system's own changes. Called once. */
export function followSettings(): void {
  const stored = themes.find((name) => name === localStorage.getItem(kKey));
  if (stored) theme.value = stored;
  const system = matchMedia("(prefers-color-scheme: dark)");
  const apply = () => {
    const isDark = theme.value === "dark" || (theme.value === "system" && system.matches);
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    dark.value = isDark;
    localStorage.setItem(kKey, theme.value);
  };
  system.addEventListener("change", apply);
  effect(apply);
}
