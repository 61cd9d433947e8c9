// The copy button of a console block copies its commands, without prompts and output. A line "$ command" is a command, lines
// "> …" right after it continue it, as tests/tutorials/run_pages.py reads them.
document.addEventListener("click", (event) => {
  const button = event.target.closest(".md-clipboard");
  const block = button && document.querySelector(button.dataset.clipboardTarget);
  if (!block || !block.textContent.startsWith("$ ")) return;
  const commands = [];
  let inside = false;
  for (const line of block.textContent.split("\n")) {
    inside = line.startsWith("$ ") || (inside && (line === ">" || line.startsWith("> ")));
    if (inside) commands.push(line.slice(2));
  }
  button.setAttribute("data-clipboard-text", commands.join("\n") + "\n");
}, true);
