/** The style of the element: one sheet for all, adopted, which no policy for styles forbids. */

const TEXT = /* css */ `
:host {
  display: block;
  position: relative;
  aspect-ratio: 4 / 3;
  overflow: hidden;
}
:host([hidden]) { display: none; }
.frame {
  position: absolute;
  inset: 0;
  --text: #e3e6ea;
  --bar: #191b1ed9;
  --accent: #a594ff;
  color-scheme: dark;
}
.frame.light {
  --text: #22272c;
  --bar: #f6f7f8e6;
  --accent: #5b46d6;
  color-scheme: light;
}
* { box-sizing: border-box; }
[hidden] { display: none !important; }
.stage, .poster { position: absolute; inset: 0; width: 100%; height: 100%; outline: none; }
.stage canvas { touch-action: var(--touch-action, pan-y) !important; }
.stage:focus-visible { box-shadow: inset 0 0 0 3px var(--accent); z-index: 1; }
.poster { object-fit: contain; }
.message {
  position: absolute;
  inset: auto 0 0;
  margin: 0;
  max-height: 100%;
  overflow: auto;
  padding: 8px 12px;
  background: var(--bar);
  color: var(--text);
  font: 13px/1.5 system-ui, sans-serif;
  white-space: pre-wrap;
  overflow-wrap: anywhere;
  z-index: 3;
}
.message.alone { inset: 0; display: grid; place-content: center; }
.controls {
  position: absolute;
  inset: auto 0 0;
  display: flex;
  align-items: center;
  gap: 8px;
  padding: 4px 10px;
  background: var(--bar);
  color: var(--text);
  font: 13px/1 system-ui, sans-serif;
  z-index: 2;
}
.play {
  flex: none;
  width: 28px;
  height: 28px;
  padding: 0;
  border: 0;
  border-radius: 4px;
  background: none;
  color: inherit;
  cursor: pointer;
}
.play::before {
  content: "";
  display: block;
  width: 14px;
  height: 14px;
  margin: auto;
  background: currentColor;
  clip-path: polygon(10% 0, 100% 50%, 10% 100%);
  forced-color-adjust: none;
}
.play.playing::before { clip-path: polygon(10% 0, 40% 0, 40% 100%, 60% 100%, 60% 0, 90% 0, 90% 100%, 10% 100%); }
.play:focus-visible, .time:focus-visible { outline: 2px solid var(--accent); }
.time { flex: 1; min-width: 0; height: 24px; margin: 0; accent-color: var(--accent); cursor: pointer; }
.seconds { flex: none; font-variant-numeric: tabular-nums; }
a { flex: none; padding: 6px 2px; color: inherit; }
a:focus-visible { outline: 2px solid var(--accent); }
@media (pointer: coarse) {
  .play { width: 44px; height: 44px; }
  .time { height: 44px; }
}
`;

let sheet: CSSStyleSheet | undefined;

/** Gives a shadow root the element's style. */
export function adoptStyle(root: ShadowRoot): void {
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(TEXT);
  }
  root.adoptedStyleSheets = [sheet];
}
