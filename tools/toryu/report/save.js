// Saves what the stages show: as a picture, or the run from its start to its end as a video.
const VIDEO = {type: "video/webm", rate: 30, bits: 8e6};  // [1/s], [1/s]

class Saver {
  constructor(player) {
    this.player = player;
    this.canvas = document.createElement("canvas");
    byId("picture").addEventListener("click", () => this.picture());
    byId("video").addEventListener("click", () => this.video());
    if (!window.MediaRecorder || !this.canvas.captureStream) {
      byId("video").disabled = true;
      byId("video").title = "This browser cannot record a video";
    }
    player.drawn.push(() => { if (this.recording) this.compose(); });
  }

  // All stages side by side, on paper.
  compose() {
    const parts = this.player.stages.map(({canvas}) => canvas), gap = 12 * (window.devicePixelRatio || 1);
    const width = parts.reduce((sum, part) => sum + part.width + gap, -gap), height = Math.max(...parts.map((part) => part.height));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
    const context = this.canvas.getContext("2d");
    context.fillStyle = cssColour("--paper");
    context.fillRect(0, 0, width, height);
    let x = 0;
    for (const part of parts) {
      context.drawImage(part, x, 0);
      x += part.width + gap;
    }
  }

  picture() {
    this.compose();
    this.canvas.toBlob((blob) => this.hand(blob, `${document.title} ${this.player.time.toFixed(4)} s.png`), "image/png");
  }

  // As the player shows it, at its speed; a second click, or a pause, ends it.
  video() {
    if (this.recording) return this.recording.stop();
    const {player} = this, pieces = [], button = byId("video"), words = button.textContent;
    if (player.playing) player.toggle();
    player.show(0);
    this.compose();
    const recorder = new MediaRecorder(this.canvas.captureStream(VIDEO.rate), {mimeType: VIDEO.type, videoBitsPerSecond: VIDEO.bits});
    recorder.ondataavailable = ({data}) => pieces.push(data);
    recorder.onstop = () => {
      this.recording = player.paused = null;
      button.textContent = words;
      if (player.playing) player.toggle();
      this.hand(new Blob(pieces, {type: VIDEO.type}), `${document.title}.webm`);
    };
    this.recording = recorder;
    button.textContent = "Stop";
    player.paused = () => setTimeout(() => recorder.state === "recording" && recorder.stop(), 2000 / VIDEO.rate);
    recorder.start();
    player.toggle();
  }

  hand(blob, name) {
    const link = html("a", {href: URL.createObjectURL(blob), download: name.replace(/[^\w .,()+-]+/g, "_")}, document.body);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }
}
