/** Parameters of a joint's type: order, axis, pitch, mode, DOFs. */

import type { Vec3 } from '../../../math/vec3.ts';
import type { Parameter, ParameterValues } from '../../../model/joint-types/parameters.ts';
import { JOINT_TEXTS } from '../../../model/joint-types/texts.ts';
import {
  axisOf,
  dofsOf,
  isOffered,
  MOTION_KINDS,
  motionOfKind,
  parameterOf,
  parametersOf,
  withParameter,
} from '../../../model/skeleton/joint-types.ts';
import type { Motion } from '../../../model/skeleton/skeleton.ts';
import { button, element } from '../../widgets/dom.ts';
import { contentOf } from '../../widgets/section.ts';
import { choiceRow, numberRow, type SectionContext, type SectionRow, textRow, vectorRow } from './section-rows.ts';
import { typedList } from './typed-list.ts';

/** What the rows depend on: the type, its DOFs and whether it uses an axis. */
export function motionShape(motion: Motion): string {
  const names = dofsOf(motion).map(({ name }) => name);
  return [motion.kind, ...names, ...(axisOf(motion) ? ['axis'] : [])].join(' ');
}

export interface MotionEdits {
  /** One undo step. */
  set(motion: Motion): void;
  /** Part of an undo step. */
  preview(motion: Motion): void;
}

const PRESETS: readonly (readonly [string, Vec3])[] = [
  ['x', [1, 0, 0]],
  ['y', [0, 1, 0]],
  ['z', [0, 0, 1]],
];

/** @param made what the rows are for; `now` is the same with current numbers */
export function motionRows(
  context: SectionContext,
  made: Motion,
  now: () => Motion | undefined,
  edits: MotionEdits,
): SectionRow[] {
  const rows = parametersOf(made).flatMap(([name, parameter]) =>
    parameter.type === 'axis' && !axisOf(made) ? [] : parameterRows(context, name, parameter, now, edits),
  );
  return [kindRow(made, now, edits.set), ...rows];
}

function parameterRows(
  context: SectionContext,
  name: string,
  parameter: Parameter,
  now: () => Motion | undefined,
  { set, preview }: MotionEdits,
): SectionRow[] {
  const { label } = parameter;
  if (label === undefined) return [];
  const value = <T extends Parameter['type']>(type: T) => {
    const motion = now();
    return motion && parameterOf(motion, name, type);
  };
  // As long as the joint's type has such a parameter.
  const edit = (apply: (motion: Motion) => void) => (next: ParameterValues[Parameter['type']]) => {
    const motion = now();
    if (motion && value(parameter.type) !== undefined) apply(withParameter(motion, name, next));
  };
  switch (parameter.type) {
    case 'choice': {
      const options = parameter.choices.map((choice) => [choice, parameter.describe(choice)] as const);
      return [choiceRow(label, options, () => value('choice'), edit(set))];
    }
    case 'list': {
      const { choices } = parameter;
      const title = `Multiplied from left to right; each of ${choices.join(' ')} at most once`;
      const write = (text: string) => {
        const list = typedList(text, choices);
        if (typeof list === 'string') context.wb.messages.note(list, 'warning');
        else edit(set)(list);
      };
      return [textRow(label, () => value('list')?.join(' ') ?? '', write, title)];
    }
    case 'axis':
      return [
        vectorRow(context, label, 0.01, () => value('axis'), edit(preview), noDirection),
        presetRow(context, edit(set)),
      ];
    case 'angles':
      return [vectorRow(context, label, 0.01, () => value('angles'), edit(preview))];
    case 'number':
      return [numberRow(context, label, 0.01, () => value('number'), edit(preview))];
  }
}

function noDirection(axis: Vec3): string | undefined {
  return axis.every((part) => part === 0)
    ? 'An axis of 0 0 0 has no direction. Enter the new one first, or choose x, y or z below.'
    : undefined;
}

function presetRow({ section }: SectionContext, set: (axis: Vec3) => void): SectionRow {
  const presets = PRESETS.map(([letter, axis]) =>
    button(`Axis along ${letter}`, { class: 'plain' }, element('span', { class: `axis-${letter}` }, letter), () =>
      set(axis),
    ),
  );
  const line = element('div', { class: 'rig-row is-second' }, ...presets);
  contentOf(section).append(line);
  return { line, update() {} };
}

function kindRow(made: Motion, now: () => Motion | undefined, set: (motion: Motion) => void): SectionRow {
  // Types of captures are only offered to joints that have them.
  const kinds = MOTION_KINDS.filter((kind) => isOffered(kind) || kind === made.kind);
  return choiceRow(
    'Type',
    kinds.map((kind) => [kind, JOINT_TEXTS[kind].label] as const),
    () => now()?.kind,
    (kind) => {
      const before = now();
      if (before && kind !== before.kind && isOffered(kind)) set(motionOfKind(kind, before));
    },
    (kind) => JOINT_TEXTS[kind].summary,
  );
}
