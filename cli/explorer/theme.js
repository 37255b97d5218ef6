// Light or dark, as the reader's system is: what a style sheet cannot reach, since Bokeh draws it.

const PAPER = {
  light: { back: "#ffffff", ink: "#333333", quiet: "#888888", grid: "#e5e5e5" },
  dark: { back: "#16191d", ink: "#d8dade", quiet: "#80868e", grid: "#2e3338" },
};

const theme = {
  query: window.matchMedia("(prefers-color-scheme: dark)"),

  get dark() {
    return this.query.matches;
  },

  get paper() {
    return PAPER[this.dark ? "dark" : "light"];
  },

  // Call back now and whenever the system changes.
  follow(act) {
    this.query.addEventListener("change", act);
    act();
  },

  // Give a figure the colours of the page.
  dress(figure) {
    const { back, ink, quiet, grid } = this.paper;
    figure.setv({ background_fill_color: back, border_fill_color: back, outline_line_color: quiet });
    for (const part of [...figure.below, ...figure.left, ...figure.right, ...figure.center]) {
      const wanted = {
        axis_label_text_color: ink, major_label_text_color: ink, axis_line_color: quiet, major_tick_line_color: quiet,
        grid_line_color: grid, bar_line_color: quiet, background_fill_color: back,
      };
      const own = Object.fromEntries(Object.entries(wanted).filter(([name]) => name in part.properties));
      if (part.type === "Grid") part.setv({ grid_line_color: grid });
      else part.setv(own);
    }
  },

  // The colour of what is unstable: nearer to the page than the line that it belongs to.
  faded(track) {
    if (!this.dark) return track.faded;
    const [own, back] = [this.seen(track.colour), this.paper.back].map((one) => [1, 3, 5].map((i) => parseInt(one.slice(i, i + 2), 16)));
    return "#" + own.map((part, i) => Math.round(0.5 * (part + back[i])).toString(16).padStart(2, "0")).join("");
  },

  // A colour of a line that can be seen on the page: a dark one is lightened on a dark page.
  seen(colour) {
    if (!this.dark || !/^#[0-9a-f]{6}$/i.test(colour)) return colour;
    const parts = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
    const light = (0.3 * parts[0] + 0.59 * parts[1] + 0.11 * parts[2]) / 255;
    if (light > 0.5) return colour;
    return "#" + parts.map((one) => Math.round(one + (0.9 - 0.7 * light) * (255 - one)).toString(16).padStart(2, "0")).join("");
  },
};
