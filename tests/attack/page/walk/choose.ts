/** Chance: what a walk does next, among what the page offers and anywhere. */
import type { Chance } from '../../attack.ts';
import type { Control } from './controls.ts';
import { ALT, CTRL, type MouseButton, type Point, SHIFT, type WalkEvent } from './events.ts';
import { KEYS } from './keys.ts';

export interface Size {
  readonly width: number;
  readonly height: number;
}

const MODIFIERS = [0, 0, 0, 0, SHIFT, CTRL, ALT, CTRL | SHIFT, CTRL | ALT] as const;
const BUTTONS: readonly MouseButton[] = ['left', 'left', 'left', 'left', 'right', 'middle'];
/** The browser's own: they close, reload or leave the page, or print it. */
const NOT_CTRL = /^[nrtwqpu0-9jio=-]$/;
const NOT_ALT = /^(ArrowLeft|ArrowRight|Home|[def])$/;
/** Of what changes a document, and leads from mode to mode. */
const OFTEN = [
  'k',
  'e',
  'v',
  'i',
  'o',
  'c',
  'q',
  'Enter',
  'Delete',
  'ArrowRight',
  ' ',
  'Escape',
  '1',
  '3',
  's',
] as const;
const TYPED = ['0', '1', '-1', '45', '12.5', '1e3', '2*3', '-0.001', '1e308', 'NaN', 'x', '', '90°', '0.0333', ' 7 '];
/** For the search of commands. */
const WORDS = [
  ...['rig', 'ik', 'pin', 'take', 'curve', 'dope', 'measure', 'compare', 'review', 'retarget', 'mirror', 'key', 'pose'],
  ...['joint', 'skin', 'weight', 'simplify', 'bake', 'loop', 'hold', 'resample', 'crop', 'smooth', 'limit', 'link'],
  ...[
    'marker',
    'ghost',
    'path',
    'paste',
    'copy',
    'delete',
    'duplicate',
    'instance',
    'unit',
    'frame',
    'source',
    'steps',
  ],
] as const;

/** What a walk can choose from. */
export interface Choice {
  readonly controls: readonly Control[];
  readonly size: Size;
  readonly hasTouch: boolean;
  /** Number of sets of files that can be dropped. */
  readonly drops: number;
}

/** One act, of one event or of several that belong together. */
export function nextAct({ controls, size, hasTouch, drops }: Choice, chance: Chance): WalkEvent[] {
  const { random, below } = chance;
  const anywhere = (): Point => [below(size.width), below(size.height)];
  const items = controls.filter(({ kind }) => kind === 'item');
  // An open menu.
  if (items.length > 0 && random() < 0.5) return [click(within(pick(items, chance), chance), 'left', 1, 0)];
  const kind = random();
  // Out of dialogs, which have all of the page's controls to themselves.
  if (kind < 0.03) return [pressed('Escape', 0)];
  if (kind < 0.27) return [key(chance)];
  if (kind < 0.5 && controls.length > 0) return atControl(pick(evenByKind(controls, chance), chance), size, chance);
  if (kind < 0.6) return [click(anywhere(), pick(BUTTONS, chance), random() < 0.15 ? 2 : 1, pick(MODIFIERS, chance))];
  if (kind < 0.66) return [{ kind: 'move', to: anywhere() }];
  if (kind < 0.76) {
    const canvases = controls.filter((control) => control.kind === 'canvas');
    const from = canvases.length > 0 ? within(pick(canvases, chance), chance) : anywhere();
    return [drag(from, size, chance)];
  }
  if (kind < 0.79) return [{ kind: 'down', at: anywhere(), button: pick(BUTTONS, chance) }];
  if (kind < 0.84) return [{ kind: 'up', at: anywhere(), button: pick(BUTTONS, chance) }];
  if (kind < 0.88) {
    const by: Point = [below(200) - 100, below(400) - 200];
    return [{ kind: 'wheel', at: anywhere(), by, modifiers: pick([0, SHIFT, ALT], chance) }];
  }
  if (kind < 0.8815) return [{ kind: 'drop', drop: below(drops) }];
  if (kind < 0.889) return [pressed('z', random() < 0.5 ? CTRL : CTRL | SHIFT)];
  if (kind < 0.93) return [pressed(pick(['c', 'x', 'v', 'd', 'a'], chance), CTRL)];
  if (kind < 0.965) return [pressed('k', CTRL), { kind: 'text', text: pick(WORDS, chance) }, pressed('Enter', 0)];
  if (hasTouch) return [touch(anywhere, size, chance)];
  return [key(chance)];
}

/** Canvases are few, rows and buttons many. */
function evenByKind(controls: readonly Control[], chance: Chance): readonly Control[] {
  const { kind } = pick(controls, chance);
  const wanted = chance.random() < 0.5 ? kind : pick(['field', 'canvas', 'row', 'button'] as const, chance);
  const found = controls.filter((control) => control.kind === wanted);
  return found.length > 0 ? found : controls;
}

function atControl(control: Control, size: Size, chance: Chance): WalkEvent[] {
  const { random } = chance;
  const at = within(control, chance);
  if (control.kind === 'field' && random() < 0.7) {
    const text: WalkEvent = { kind: 'text', text: pick(TYPED, chance) };
    const end = pressed(pick(['Enter', 'Enter', 'Tab', 'Escape', 'ArrowUp'], chance), 0);
    return [click(at, 'left', 1, 0), pressed('a', CTRL), text, end];
  }
  if (control.kind === 'canvas' && random() < 0.6) return [drag(at, size, chance)];
  const button = random() < 0.15 ? 'right' : 'left';
  return [click(at, button, random() < 0.1 ? 2 : 1, random() < 0.8 ? 0 : pick(MODIFIERS, chance))];
}

function key(chance: Chance): WalkEvent {
  const { random } = chance;
  const name = random() < 0.4 ? pick(OFTEN, chance) : pick(KEYS, chance);
  const modifiers = pick(MODIFIERS, chance);
  if (modifiers & CTRL && NOT_CTRL.test(name)) return pressed(name, 0);
  if (modifiers & ALT && NOT_ALT.test(name)) return pressed(name, 0);
  return pressed(name, modifiers);
}

function drag(from: Point, { width, height }: Size, chance: Chance): WalkEvent {
  const { random, below } = chance;
  const path: Point[] = [from];
  const reach = random() < 0.5 ? 30 : 300;
  for (let steps = 1 + below(8); steps > 0; steps--) {
    const [x, y] = path[path.length - 1];
    const inside = (value: number, end: number) => Math.min(Math.max(value, 0), end - 1);
    path.push([inside(x + below(2 * reach) - reach, width), inside(y + below(2 * reach) - reach, height)]);
  }
  const button = random() < 0.75 ? 'left' : pick(BUTTONS, chance);
  return { kind: 'drag', path, button, modifiers: pick(MODIFIERS, chance) };
}

function touch(anywhere: () => Point, size: Size, { below, random }: Chance): WalkEvent {
  const steps = below(4);
  const path = () => {
    const at = [anywhere()];
    for (let i = 0; i < steps; i++) {
      const [x, y] = at[i];
      const near: Point = [
        Math.min(Math.max(x + below(120) - 60, 0), size.width - 1),
        Math.min(Math.max(y + below(120) - 60, 0), size.height - 1),
      ];
      at.push(near);
    }
    return at;
  };
  return { kind: 'touch', fingers: random() < 0.5 ? [path()] : [path(), path()] };
}

const pressed = (name: string, modifiers: number): WalkEvent => ({ kind: 'key', key: name, modifiers });

function click(at: Point, button: MouseButton, count: 1 | 2, modifiers: number): WalkEvent {
  return { kind: 'click', at, button, count, modifiers };
}

function within({ x, y, width, height }: Control, { random }: Chance): Point {
  return [Math.floor(x + random() * width), Math.floor(y + random() * height)];
}

const pick = <T>(all: readonly T[], { below }: Chance): T => all[below(all.length)];
