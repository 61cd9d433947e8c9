// Pages of the documents that the palette finds.
export const documents: readonly { page: string; title: string }[] = [
  { page: "index.html", title: "All documents" },
  { page: "start/first-texture.html", title: "Your first texture in ten minutes" },
  { page: "tutorials/own-data.html", title: "Tutorial: your own data" },
  { page: "tutorials/stylus-profile.html", title: "Tutorial: a stylus profile" },
  { page: "tutorials/several-scans.html", title: "Tutorial: an object with several scans" },
  { page: "tutorials/feel.html", title: "Tutorial: feel a texture" },
  { page: "tutorials/study.html", title: "Tutorial: a study" },
  { page: "tutorials/probe.html", title: "Tutorial: build a probe" },
  { page: "tutorials/python.html", title: "Tutorial: Python" },
  { page: "command-line.html", title: "Commands" },
  { page: "verdicts.html", title: "Verdicts" },
  { page: "roughness.html", title: "Roughness parameters" },
  { page: "recording.html", title: "Files of a recording" },
  { page: "glossary.html", title: "Glossary" },
  { page: "troubleshooting.html", title: "Troubleshooting" },
];
