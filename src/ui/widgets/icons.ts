/**
 * The page's icons, on one 16-unit grid with one line weight. Each is a list of paths; one that starts with `!` is
 * filled instead of stroked.
 */
const PATHS = {
  start: ['M3.5 3.5v9', '!M12.5 3.5v9L5.5 8z'],
  end: ['M12.5 3.5v9', '!M3.5 3.5v9l7-4.5z'],
  back: ['M12 8h-1', '!M10 4v8L3.5 8z', 'M12.5 4v8'],
  forward: ['M3.5 4v8', '!M6 4v8l6.5-4z'],
  play: ['!M4.5 3v10l8.5-5z'],
  pause: ['!M4 3h3v10H4zM9 3h3v10H9z'],
  previousKey: ['M6 4 2.5 8 6 12', '!M10.5 4.6 13.9 8l-3.4 3.4L7.1 8z'],
  ripple: ['!M4.2 4.8 7.4 8l-3.2 3.2L1 8z', 'M9 8h5', 'M11.7 5.7 14 8l-2.3 2.3'],
  allRows: ['M2.5 4h11M2.5 8h11M2.5 12h11', '!M5 2.4 6.6 4 5 5.6 3.4 4z'],
  key: ['!M8 3.2 12.8 8 8 12.8 3.2 8z'],
  record: ['!M8 3.2a4.8 4.8 0 1 0 0 9.6 4.8 4.8 0 0 0 0-9.6z'],
  nextKey: ['M10 4 13.5 8 10 12', '!M5.5 4.6 8.9 8 5.5 11.4 2.1 8z'],
  previousTake: ['M4 10l4-4 4 4', 'M4 3h8', 'M4 13h8'],
  nextTake: ['M4 6l4 4 4-4', 'M4 3h8', 'M4 13h8'],
  once: ['M2.5 8h9', 'M8.5 5l3 3-3 3', 'M13.5 4v8'],
  loop: ['M5 4h5.5a3 3 0 0 1 3 3v.5', 'M11 12H5.5a3 3 0 0 1-3-3v-.5', 'M7 2 5 4l2 2', 'M9 10l2 2-2 2'],
  pingpong: ['M2.5 5h10', 'M10 2.5 12.5 5 10 7.5', 'M13.5 11h-10', 'M6 8.5 3.5 11 6 13.5'],
  continue: ['M2 8h11', 'M10 5l3 3-3 3', 'M4 5.5v5', 'M6.5 6.5v3'],
  menu: ['M2.5 4.5h11M2.5 8h11M2.5 11.5h11'],
  fold: ['M6 3.5 10.5 8 6 12.5'],
  close: ['M4 4l8 8M12 4l-8 8'],
  check: ['M3.5 8.5 6.5 11.5 12.5 4.5'],
  mixed: ['M4 8h8'],
  dot: ['!M8 5.4a2.6 2.6 0 1 0 0 5.2 2.6 2.6 0 0 0 0-5.2z'],
  search: ['M7 2.8a4.2 4.2 0 1 0 0 8.4 4.2 4.2 0 0 0 0-8.4z', 'M10.2 10.2 13.2 13.2'],
  copy: ['M5.5 5.5h7v7h-7z', 'M3.5 10.5v-7h7'],
  more: ['!M3 7h2v2H3zM7 7h2v2H7zM11 7h2v2h-2z'],
  character: ['M8 2.2a2 2 0 1 0 0 4 2 2 0 0 0 0-4z', 'M8 6.2v4', 'M3.5 7.5 8 6.8l4.5.7', 'M5 14l3-3.8L11 14'],
  joint: ['M8 5.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z', 'M8 2v3.5M8 10.5V14'],
  skeleton: [
    'M4.6 3a1.6 1.6 0 1 0 0 3.2 1.6 1.6 0 0 0 0-3.2z',
    'M11.4 9.8a1.6 1.6 0 1 0 0 3.2 1.6 1.6 0 0 0 0-3.2z',
    'M5.8 5.7l4.4 4.6',
  ],
  skin: ['M8 2.5 13.5 6 11 13H5L2.5 6z', 'M2.5 6h11M8 2.5 5 13M8 2.5 11 13'],
  take: ['M2 11c2.5 0 3-6.5 6-6.5s3.5 6.5 6 6.5', '!M8 2.8 9.7 4.5 8 6.2 6.3 4.5z'],
  morph: ['M3 9.5c0-3.5 2-6 5-6s5 2.5 5 6', 'M3 12.5h10', 'M5.5 9.8c.8.8 4.2.8 5 0'],
  file: ['M4 2.5h5l3 3v8H4z', 'M9 2.5v3h3'],
  unused: ['M4 2.5h5l3 3v8H4z', 'M6.2 7.2l3.6 3.6M9.8 7.2l-3.6 3.6'],
  error: ['M8 2.5a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11z', 'M8 5v3.6', '!M7.3 10.3h1.4v1.4H7.3z'],
  warning: ['M8 2.8 14 13H2z', 'M8 6.5v3', '!M7.4 10.5h1.2v1.2H7.4z'],
  info: ['M8 2.5a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11z', 'M8 7.5V11', '!M7.3 4.6h1.4V6H7.3z'],
  boxes: ['M8 2.3 13 5v6l-5 2.7L3 11V5z', 'M3 5l5 2.7L13 5M8 7.7v6'],
  bones: ['M4.2 9.2a1.7 1.7 0 1 0 2.6 2.2l4.6-4.6a1.7 1.7 0 1 0-2.2-2.6z'],
  axes: ['M6 2.5V10h7.5', 'M6 10l-3.5 3.5'],
  names: ['M2.5 4.5h7l4 3.5-4 3.5h-7z', 'M5 8h3'],
  normals: ['M2.5 12.5c3-2 8-2 11 0', 'M5 11.5 4 5M8 11V4M11 11.5 12 5'],
  grid: ['M2.5 5.5h11M2.5 10.5h11M5.5 2.5v11M10.5 2.5v11'],
  shadow: ['M8 2.5a3.2 3.2 0 1 0 0 6.4 3.2 3.2 0 0 0 0-6.4z', 'M3 12.2c2-1.2 8-1.2 10 0-2 1.2-8 1.2-10 0z'],
  perspective: ['M3 4.5l7-1.7v10.4l-7-1.7z', 'M10 5.5h3v5h-3'],
  outliner: ['M2.5 3h11v10h-11z', 'M6.5 3v10'],
  inspector: ['M2.5 3h11v10h-11z', 'M9.5 3v10'],
  save: ['M8 2.5v7M5 6.8l3 3 3-3', 'M3 11v2.5h10V11'],
  undo: ['M6 3.5 2.5 7 6 10.5', 'M2.5 7H10a3 3 0 0 1 0 6H7.5'],
  redo: ['M10 3.5 13.5 7 10 10.5', 'M13.5 7H6a3 3 0 0 0 0 6h2.5'],
  window: ['M7 3.5H3.5v9h9V9', 'M9.5 3h3.5v3.5', 'M13 3 7.5 8.5'],
  folder: ['M2.5 4h4l1.5 1.8h5.5v7h-11z'],
  frame: ['M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3', 'M6 8h4M8 6v4'],
  flat: ['M2 11c3 0 3-6 6-6s3 6 6 6', 'M5.5 3h5'],
  linear: ['M2 12.5 8 4.5 14 12.5', '!M8 2.4 10 4.5 8 6.6 6 4.5z'],
  smooth: ['M2 13c3-1 3.5-4 6-5.5S12 4 14 2.5', 'M4 11.3 12 3.7', '!M8 5.4 10 7.5 8 9.6 6 7.5z'],
  auto: ['M2 12.5c3 0 3-7 6-7 2.5 0 2 4 6 4', '!M8 2.2 10.4 6.6 5.6 6.6z'],
  step: ['M2 12h6V4h6', '!M6 12 8 10 10 12 8 14z'],
  fixed: ['M3.5 12.5 12.5 3.5', '!M8 5.9 10 8 8 10.1 6 8z', '!M2 11h3v3H2zM11 2h3v3h-3z'],
  unify: ['M2.5 11.5 13.5 4.5', '!M8 5.9 10 8 8 10.1 6 8z'],
  break: ['M2.5 11.5 8 7l5.5 4.5', '!M8 4.9 10 7 8 9.1 6 7z'],
  handlesAuto: ['M2 11 14 5', '!M8 6 9.9 8 8 10 6.1 8z', 'M11 12.5l1.6-3.6 1.6 3.6M11.6 11.4h2'],
  handlesAlone: ['M8 8l6-4', 'M2 8h1M5 8h1', '!M8 6 9.9 8 8 10 6.1 8z'],
  handlesTogether: ['M2 12 14 4', '!M8 6 9.9 8 8 10 6.1 8z'],
  insertKey: ['!M6.5 5 10 8.5 6.5 12 3 8.5z', 'M12 2.5v5M9.5 5h5'],
  deleteKey: ['!M6.5 5 10 8.5 6.5 12 3 8.5z', 'M10 5h4.5'],
  snapFrames: ['M4 2.5v11M12 2.5v11', 'M8 2.5v2M8 11.5v2', '!M8 5.6 10.4 8 8 10.4 5.6 8z'],
  snapValues: ['M2.5 4h11M2.5 12h11', 'M2.5 8h2M11.5 8h2', '!M8 5.6 10.4 8 8 10.4 5.6 8z'],
  collideReplace: ['M8 2v3M6.5 4 8 5.5 9.5 4', '!M8 7 11 10 8 13 5 10z'],
  collideStep: ['M2 12h6V5h6', '!M8 10.2 9.8 12 8 13.8 6.2 12zM8 3.2 9.8 5 8 6.8 6.2 5z'],
  normalised: ['M2.5 3h11M2.5 13h11', 'M2.5 8c2-7 3.5-7 5.5 0s3.5 7 5.5 0'],
  fitAll: ['M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3', 'M4.5 10c2-5 5-5 7 0'],
  why: ['M5.6 6a2.4 2.4 0 1 1 3.6 2.1c-.8.5-1.2.9-1.2 1.9', '!M7.3 11.6h1.4V13H7.3z'],
  scaleFrame: [
    'M4 4h8v8H4z',
    '!M2.8 2.8h2.4v2.4H2.8zM10.8 2.8h2.4v2.4h-2.4zM2.8 10.8h2.4v2.4H2.8zM10.8 10.8h2.4v2.4h-2.4z',
  ],
  curveTools: ['M2 10.5c2-6 4-6 6-2.5s4 3 6-3', 'M3 13.5h10'],
  extrapolate_constant: ['M2 8h12'],
  extrapolate_linear: ['M2.5 12.5 13.5 3.5'],
  extrapolate_cycle: ['M2 12 7 4.5v7.5L12 4.5V12'],
  extrapolate_cycle_offset: ['M2 13.5 6 9v2.5L10 7v2l4-4.5'],
  extrapolate_bounce: ['M2 11.5 5 4.5 8 11.5l3-7 3 7'],
  eye: [
    'M1.8 8c1.6-2.7 3.7-4 6.2-4s4.6 1.3 6.2 4c-1.6 2.7-3.7 4-6.2 4S3.4 10.7 1.8 8z',
    '!M8 6.2a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.6z',
  ],
  eyeOff: ['M1.8 8c1.6-2.7 3.7-4 6.2-4s4.6 1.3 6.2 4c-1.6 2.7-3.7 4-6.2 4S3.4 10.7 1.8 8z', 'M3 13 13 3'],
  ghosts: [
    'M10 2.5a2 2 0 1 0 0 4 2 2 0 0 0 0-4z',
    'M10 6.5v3.6L12.5 14M10 10.1 7.8 14M12.6 9 10 7.2 7.6 9',
    'M5 3.2a1.8 1.8 0 0 0 0 3.4M5.2 7v3.4L3.4 14M5.2 8 3 9.6',
  ],
  limits: ['M2.5 11.5a6 6 0 0 1 11 0', 'M8 11.5 11.2 6.6', 'M2.5 11.5 4 13M13.5 11.5 12 13'],
  select: ['M4 2.2 12.6 8.6 8.8 9.2 10.9 13.4 8.9 14.3 6.9 10.1 4 12.6z'],
  pin: ['M6 2.5h4l-.5 4 2 2.5h-7l2-2.5z', 'M8 9v4.5'],
} as const;

export type IconName = keyof typeof PATHS;

const SVG = 'http://www.w3.org/2000/svg';

const shown = new WeakMap<Element, IconName>();

/** Shows an icon as all that an element contains. */
export function setIcon(target: Element, name: IconName): void {
  if (shown.get(target) === name) return;
  shown.set(target, name);
  target.replaceChildren(icon(name));
}

/** Decorative only: its control has the accessible name. */
export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS(SVG, 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  for (const text of PATHS[name]) {
    const path = document.createElementNS(SVG, 'path');
    const filled = text.startsWith('!');
    path.setAttribute('d', filled ? text.slice(1) : text);
    if (filled) path.setAttribute('class', 'filled');
    svg.append(path);
  }
  return svg;
}
