// The search's index is a script: a page of a disk, or of the studio's server, cannot request it as data.
document.write('<script src="' + document.currentScript.dataset.index + '"></' + "script>");
// For a page that is opened from a disk a browser starts no worker, so its script runs in a hidden frame.
// The theme's worker looks for `IFrameWorker` in its parent and then finds its languages next to its own script.
if (location.protocol === "file:") {
  window.IFrameWorker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.appendChild(this.frame);
      this.waiting = [];
      window.addEventListener("message", (event) => {
        if (event.source !== this.frame.contentWindow) return;
        if (event.data === "asperity:ready") {
          const waiting = this.waiting;
          this.waiting = null;
          for (const data of waiting) this.postMessage(data);
          return;
        }
        const message = new MessageEvent("message", {data: event.data});
        if (this.onmessage) this.onmessage(message);
        this.dispatchEvent(message);
      });
      const source = String(url).replace(/&/g, "&amp;").replace(/"/g, "&quot;");
      const inside = this.frame.contentWindow.document;
      inside.open();
      inside.write(
        '<script>postMessage = (data) => parent.postMessage(data, "*");' +
          "importScripts = (...all) => all.reduce((before, url) => before.then(() => new Promise((done, fail) => {" +
          'const script = document.createElement("script"); script.src = url; script.onload = done; script.onerror = fail;' +
          "document.body.appendChild(script); })), Promise.resolve());</" + "script>" +
          '<script src="' + source + '"></' + 'script><script>postMessage("asperity:ready")</' + "script>");
      inside.close();
    }
    postMessage(data) {
      if (this.waiting) this.waiting.push(data);
      else this.frame.contentWindow.dispatchEvent(new MessageEvent("message", {data, source: window}));
    }
    terminate() {
      this.frame.remove();
    }
  };
  window.Worker = window.IFrameWorker;
}
