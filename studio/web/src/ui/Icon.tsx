const PATHS = {
  undo: "M6 4 2.5 7.5 6 11M3 7.5h6.5a4 4 0 0 1 0 8H7",
  redo: "M10 4l3.5 3.500L10 11M13 7.500H6.500a4 4 0 0 0 0 8H9",
  help: "M5.5 6a2.5 2.5 0 1 1 3.6 2.200c-.8.4-1.1.8-1.1 1.800M8 12.700v.1",
  light: "M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6M8 1v1.500M8 13.500V15M1 8h1.500M13.5 8H15M3 3l1.1 1.100M11.9 11.9 13 13M13 3l-1.1 1.100M4.1 11.9 3 13",
  dark: "M13.5 9.500A6 6 0 0 1 6.5 2.500a6 6 0 1 0 7 7z",
  system: "M2 3h12v8H2zM6 14h4M8 11v3",
  close: "M4 4l8 8M12 4l-8 8",
  reset: "M3 8a5 5 0 1 0 1.5-3.500L3 6M3 2.500V6h3.5",
  play: "M5 3l8 5-8 5z",
  stop: "M4 4h8v8H4z",
  pause: "M5.5 3.500v9M10.5 3.500v9",
  record: "M8 4a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  trash: "M3 4.500h10M6 4.500V3h4v1.500M4.5 4.500l.5 9h6l.5-9M7 7v4M9 7v4",
  plus: "M8 3v10M3 8h10",
  minus: "M3 8h10",
  fit: "M2.5 6V2.500H6M10 2.500h3.500V6M13.5 10v3.500H10M6 13.500H2.500V10",
  download: "M8 2v8M4.5 7 8 10.5 11.5 7M3 13.500h10",
  eye: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM8 6.200a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.600z",
  up: "M4 10l4-4 4 4",
  down: "M4 6l4 4 4-4",
  find: "M7 2.500a4.5 4.5 0 1 0 0 9 4.5 4.500 0 0 0 0-9M10.300 10.300 14 14",
  ruler: "M1.5 11 11 1.500 14.500 5 5 14.500zM4 8.500l1.500 1.500M6.500 6l1 1M9 3.500l1.500 1.500",
  camera: "M2 5h2.500L6 3.500h4L11.5 5H14v8H2zM8 6.500a2.3 2.3 0 1 0 0 4.6 2.3 2.3 0 0 0 0-4.600z",
} as const;

export type IconName = keyof typeof PATHS;

/** A line drawing of 16 px in the colour of the text; unseen by screen readers. */
export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true" focusable="false">
      <path d={PATHS[name]} />
    </svg>
  );
}
