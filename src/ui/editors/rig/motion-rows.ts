/** What a joint's type asks for: order, axis, pitch, mode, DOFs. */
import type { Vec3 } from '../../../math/vec3.ts';
import { AXIS_PAIRS, EULER_ORDERS, type Motion, SCALE_MODES } from '../../../model/skeleton.ts';
import { button, element } from '../../kit/dom.ts';
import { choiceRow, type FolderContext, type FolderRow, numberRow, textRow, vectorRow } from './folder-rows.ts';
import { axisOf, MOTION_LABELS, MOTION_TIPS, type MotionKind, motionOfKind, typedCompound } from './motion-choice.ts';

/** The rule's parameters, said in the shape that rows are made for. */
export function motionShape(motion: Motion): string {
  switch (motion.kind) {
    case 'scale':
      return `${motion.kind} ${motion.mode}`;
    case 'compound':
      return `${motion.kind} ${motion.dofs.join(' ')}`;
    case 'bvh':
      return `${motion.kind} ${motion.channels.join(' ')}`;
    case 'universal':
      return `${motion.kind} ${motion.order}`;
    default:
      return motion.kind;
  }
}

export interface MotionEdits {
  /** One step. */
  set(motion: Motion): void;
  /** Part of one. */
  preview(motion: Motion): void;
}

const SCALE_LABELS: Readonly<Record<(typeof SCALE_MODES)[number], string>> = {
  uniform: 'All axes alike',
  xyz: 'Each axis by itself',
  axis: 'Along an axis',
  volume: 'Axis, volume kept',
};

const PRESETS: readonly (readonly [string, Vec3])[] = [
  ['x', [1, 0, 0]],
  ['y', [0, 1, 0]],
  ['z', [0, 0, 1]],
];

/** @param made what the rows are for; `now` is the same with the numbers of now */
export function motionRows(
  context: FolderContext,
  made: Motion,
  now: () => Motion | undefined,
  { set, preview }: MotionEdits,
): FolderRow[] {
  const rows: FolderRow[] = [kindRow(made, now, set)];
  if (made.kind === 'ball' || made.kind === 'free') {
    const { kind } = made;
    const orders = EULER_ORDERS.map((order) => [order, orderText(order)] as const);
    const read = () => {
      const motion = now();
      return motion?.kind === 'ball' || motion?.kind === 'free' ? motion.order : undefined;
    };
    rows.push(choiceRow('Order', orders, read, (order) => set({ kind, order })));
  }
  if (made.kind === 'universal') {
    const pairs = AXIS_PAIRS.map((order) => [order, orderText(order)] as const);
    const read = () => {
      const motion = now();
      return motion?.kind === 'universal' ? motion.order : undefined;
    };
    rows.push(choiceRow('Order', pairs, read, (order) => set({ kind: 'universal', order })));
  }
  if (made.kind === 'scale') {
    const modes = SCALE_MODES.map((mode) => [mode, SCALE_LABELS[mode]] as const);
    const read = () => {
      const motion = now();
      return motion?.kind === 'scale' ? motion.mode : undefined;
    };
    rows.push(choiceRow('Mode', modes, read, (mode) => set({ kind: 'scale', mode, axis: axisOf(made) ?? [1, 0, 0] })));
  }
  if (axisOf(made) && (made.kind !== 'scale' || made.mode === 'axis' || made.mode === 'volume')) {
    const withAxis = (axis: Vec3): Motion | undefined => {
      const motion = now();
      return motion && 'axis' in motion ? { ...motion, axis } : undefined;
    };
    const read = () => {
      const motion = now();
      return motion && axisOf(motion);
    };
    const write = (axis: Vec3) => {
      const motion = withAxis(axis);
      if (motion) preview(motion);
    };
    const whyNot = (axis: Vec3) =>
      axis.every((part) => part === 0)
        ? 'An axis of 0 0 0 has no direction: type the new one first, or choose x, y or z below.'
        : undefined;
    rows.push(vectorRow(context, 'Axis', 0.01, read, write, whyNot));
    const presets = PRESETS.map(([letter, axis]) =>
      button(`Axis along ${letter}`, { class: 'plain' }, element('span', { class: `axis-${letter}` }, letter), () => {
        const motion = withAxis(axis);
        if (motion) set(motion);
      }),
    );
    const line = element('div', { class: 'rig-row is-second' }, ...presets);
    context.folder.$children.append(line);
    rows.push({ line, update() {} });
  }
  if (made.kind === 'screw') {
    const read = () => {
      const motion = now();
      return motion?.kind === 'screw' ? motion.pitch : undefined;
    };
    const write = (pitch: number) => {
      const motion = now();
      if (motion?.kind === 'screw') preview({ ...motion, pitch });
    };
    rows.push(numberRow(context, 'Pitch a turn', 0.01, read, write));
  }
  if (made.kind === 'compound') {
    const read = () => {
      const motion = now();
      return motion?.kind === 'compound' ? motion.dofs.join(' ') : '';
    };
    const title = 'Multiplied from left to right; each of tx ty tz rx ry rz sx sy sz at most once';
    const write = (text: string) => {
      const dofs = typedCompound(text);
      if (typeof dofs === 'string') context.wb.messages.note(dofs, 'warning');
      else set({ kind: 'compound', dofs });
    };
    rows.push(textRow('DOFs', read, write, title));
  }
  return rows;
}

function kindRow(made: Motion, now: () => Motion | undefined, set: (motion: Motion) => void): FolderRow {
  // Each name of the table is a kind.
  const kinds = (Object.keys(MOTION_LABELS) as MotionKind[]).filter((kind) => kind !== 'bvh' || made.kind === 'bvh');
  const options = kinds.map((kind) => [kind, MOTION_LABELS[kind]] as const);
  return choiceRow(
    'Type',
    options,
    () => now()?.kind,
    (kind) => {
      const before = now();
      if (before && kind !== before.kind && kind !== 'bvh') set(motionOfKind(kind, before));
    },
    (kind) => MOTION_TIPS[kind],
  );
}

/** `xyz: x first`. */
function orderText(order: string): string {
  return `${order}: ${order[0]} first`;
}
