// The time of one log: what its stretches are for, where doubts lie, a cursor that plays.
// Drag: a stretch. Click: the cursor there. Arrows move the cursor, with Shift they stretch; T, H, O
// and I say what the stretch is for; blank plays.
// The cursor is told to the page as an event "studio-time" {time, at, by}, and heeded from there;
// a robot in a frame follows it.

const ROLES = { t: "train", h: "test", o: "out", i: "in" }; // keys that say what a stretch is for
const NEAR = 7; // pixels within which an end of the stretch is taken

export default {
  props: {
    start: Number, end: Number, spans: Array, marks: Array, brush: Array, name: String,
    label: String, active: Boolean, frame: String,
  },
  emits: ["brush", "seek", "mark", "role", "playing"],
  data: () => ({ at: null, drawn: null, held: null, playing: false, speed: 1, film: null }),
  template: `
    <div class="timeline" :class="{ 'timeline-active': active }" ref="box" :tabindex="active ? 0 : -1"
         role="slider" :aria-label="label" :aria-valuemin="start" :aria-valuemax="end"
         :aria-valuenow="at ?? start" :aria-valuetext="(at ?? start).toFixed(3) + ' s'"
         @pointerdown="down" @pointermove="move" @pointerup="up" @pointercancel="held = null" @keydown="key">
      <div v-for="span in spans" :class="'timeline-span timeline-' + span.role" :style="place(span.start, span.end)"></div>
      <div v-if="stretch" class="timeline-brush" :style="place(stretch[0], stretch[1])"></div>
      <div v-if="active && at !== null" class="timeline-cursor" :style="{ left: share(at) + '%' }">
        <span :class="{ 'timeline-before': share(at) > 85 }">{{ at.toFixed(3) }} s</span></div>
      <button v-for="(mark, i) in marks" class="timeline-mark" :style="{ left: share((mark.start + mark.end) / 2) + '%' }"
              :title="mark.line" :aria-label="mark.line" :tabindex="active ? 0 : -1"
              @pointerdown.stop @click.stop="$emit('mark', i)" @keydown.stop></button>
    </div>`,
  computed: {
    stretch() { return this.drawn ?? this.brush; },
    width() { return Math.max(this.end - this.start, 1e-9); },
  },
  mounted() {
    this.heard = ({ detail }) => {
      if (!this.active || this.playing || detail.time !== this.name || detail.by === this) return;
      this.goTo(detail.at, false);
    };
    window.addEventListener("studio-time", this.heard);
  },
  unmounted() {
    this.playing = false;
    window.removeEventListener("studio-time", this.heard);
  },
  methods: {
    share(time) {
      return 100 * Math.min(1, Math.max(0, (time - this.start) / this.width));
    },
    place(from, to) { // an end that is not there is that of the log
      const left = this.share(from ?? this.start);
      return { left: left + "%", width: Math.max(0.15, this.share(to ?? this.end) - left) + "%" };
    },
    timeOf(event) {
      const box = this.$refs.box.getBoundingClientRect();
      const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      return this.start + share * this.width;
    },
    down(event) {
      if (event.button || !this.active) return;
      this.$refs.box.setPointerCapture(event.pointerId);
      const time = this.timeOf(event);
      const room = (NEAR / this.$refs.box.clientWidth) * this.width;
      const end = (this.brush ?? []).findIndex((own) => Math.abs(own - time) < room);
      this.held = { x: event.clientX, from: end < 0 ? time : this.brush[1 - end], moved: end >= 0 };
    },
    move(event) {
      if (!this.held) return;
      this.held.moved ||= Math.abs(event.clientX - this.held.x) > 3;
      if (this.held.moved) this.drawn = [this.held.from, this.timeOf(event)].sort((a, b) => a - b);
    },
    up(event) {
      if (!this.held) return;
      const { moved, from } = this.held;
      this.held = null;
      if (!moved) return this.goTo(from);
      const drawn = [from, this.timeOf(event)].sort((a, b) => a - b);
      this.drawn = null;
      if (drawn[1] > drawn[0]) this.$emit("brush", drawn);
    },
    key(event) {
      const way = { ArrowLeft: -1, ArrowRight: 1, PageDown: 10, PageUp: -10 }[event.key];
      const old = this.at ?? this.start;
      if (event.key === " ") this.play(!this.playing, this.speed);
      else if (event.key in ROLES) this.$emit("role", ROLES[event.key]);
      else if (event.key === "Escape") this.$emit("brush", null);
      else if (event.key === "Home") this.goTo(this.start);
      else if (event.key === "End") this.goTo(this.end);
      else if (way) {
        const now = Math.min(this.end, Math.max(this.start, old + (way * this.width) / 200));
        if (event.shiftKey) {
          const [a, b] = this.brush ?? [old, old];
          const ends = [Math.abs(old - a) < Math.abs(old - b) ? b : a, now];
          this.$emit("brush", ends.sort((x, y) => x - y));
        }
        this.goTo(now);
      } else return;
      event.preventDefault();
    },
    goTo(time, told = true) {
      this.at = time;
      this.pose();
      if (!told) return;
      window.dispatchEvent(new CustomEvent("studio-time", { detail: { time: this.name, at: time, by: this } }));
      if (!this.playing) this.$emit("seek", time);
    },
    // What moves with the cursor: values of every joint at increasing times.
    show(film) {
      this.film = film;
      this.pose();
    },
    posture() {
      const { time, q } = this.film ?? {};
      const at = this.at ?? this.start;
      if (!time?.length) return null;
      let low = 0, high = time.length - 1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (time[middle] <= at) low = middle;
        else high = middle;
      }
      const share = high > low ? Math.min(1, Math.max(0, (at - time[low]) / (time[high] - time[low]))) : 0;
      const between = Object.entries(q).map(([name, own]) => [name, own[low] + share * (own[high] - own[low])]);
      return Object.fromEntries(between.filter(([, value]) => Number.isFinite(value)));
    },
    pose() {
      const q = this.frame && this.posture();
      if (q) window.toRobot(this.frame, { modeler: "posture", q });
    },
    toggle(speed) {
      this.play(!this.playing, speed);
    },
    play(on, speed) {
      this.speed = speed;
      if (on === this.playing) return;
      this.playing = on;
      this.$emit("playing", on);
      if (!on) return this.$emit("seek", this.at);
      if (this.at === null || this.at >= this.end) this.at = this.start;
      let last = performance.now();
      const step = (now) => {
        if (!this.playing) return;
        const next = this.at + (this.speed * (now - last)) / 1000;
        last = now;
        this.goTo(Math.min(next, this.end));
        if (next < this.end) requestAnimationFrame(step);
        else this.play(false, this.speed);
      };
      requestAnimationFrame(step);
    },
  },
};
