// Stands in for Worker where a page is opened from the disk, of which browsers start none: the script runs in a hidden frame
// of the page, and messages go to and fro as events. As much of Worker as the theme's search uses.
window.Worker = class extends EventTarget {
  constructor(url) {
    super();
    this.waiting = [];
    const frame = document.createElement("iframe");
    frame.hidden = true;
    document.body.append(frame);
    this.inside = frame.contentWindow;
    this.inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
    const script = this.inside.document.createElement("script");
    script.src = url;
    script.onload = () => {
      for (const data of this.waiting.splice(0)) this.deliver(data);
      this.waiting = null;
    };
    this.inside.document.body.append(script);
  }

  postMessage(data) {
    if (this.waiting) this.waiting.push(data);
    else this.deliver(data);
  }

  deliver(data) {
    this.inside.dispatchEvent(new MessageEvent("message", { data }));
  }
};
