import { copyPicture, copyText, fileName, saveFile } from "../save/files";
import { pngOfSvg } from "../save/pngOfSvg";
import { SaveMenu } from "../ui/SaveMenu";
import { seriesColour, themeColour } from "./colours";
import { plotCsv } from "./plotCsv";
import { plotSvg } from "./plotSvg";
import type { PlotProps } from "./props";
import type { Series } from "./series";
import type { Range } from "./zoom";

const kSize = { width: 800, height: 420 };

/** The plot as SVG, PNG, CSV, or on the clipboard: the range that is shown as a picture, all values as a table. */
export function PlotSave({ plot, shown, range }: { plot: PlotProps; shown: readonly Series[]; range(): Range | null }) {
  const svg = (): string => {
    const over = range();
    if (!over) throw new Error("Nothing can be saved yet.");
    return plotSvg({ ...plot, series: shown }, over, {
      ...kSize,
      background: themeColour("--panel"),
      text: themeColour("--text-1"),
      grid: themeColour("--line"),
      colours: shown.map((one, index) => seriesColour(one.colour, index)),
    });
  };
  const png = () => pngOfSvg(svg(), kSize.width, kSize.height);
  const name = fileName(plot.label);
  return (
    <SaveMenu
      what="this plot"
      testId={plot.testId && `${plot.testId}-save`}
      choices={[
        { words: "Save as SVG", run: () => saveFile(`${name}.svg`, svg(), "image/svg+xml") },
        { words: "Save as PNG", run: async () => saveFile(`${name}.png`, await png(), "image/png") },
        { words: "Save values as CSV", run: () => saveFile(`${name}.csv`, plotCsv(plot), "text/csv") },
        { words: "Copy the image", run: async () => copyPicture(await png()) },
        { words: "Copy the values", run: () => copyText(plotCsv(plot)) },
      ]}
    />
  );
}
