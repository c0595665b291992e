/**
 * A take as a table: a row a frame.
 *
 *     time     Hips.px Hips.py Hips.pz  Hips.qx Hips.qy Hips.qz Hips.qw     …     LeftFoot.contact …
 *
 * Positions and quaternions are world ones: local rotations are conj(q_parent) · q. What is the same in all rows is
 * told beside the table.
 */
import type { Floats } from './data-array.ts';
import type { TakeArrays } from './take-arrays.ts';

/** Value r of a column is `data[first + r · step]`. */
export interface TableColumn {
  readonly name: string;
  readonly data: Floats | Uint8Array;
  readonly first: number;
  readonly step: number;
}

const AXES = ['x', 'y', 'z', 'w'];

/** The columns of a take's table, each a view into its arrays: rows of `data` from `first`, `step` apart. */
export function tableColumns(arrays: TakeArrays): readonly TableColumn[] {
  const { positions, worldQuat, contacts, contactJoints, times } = arrays;
  const names = columnNames(arrays);
  const J = names.length;
  return [
    { name: 'time', data: times, first: 0, step: 1 },
    ...names.flatMap((name, j) => [
      ...[0, 1, 2].map((k) => ({ name: `${name}.p${AXES[k]}`, data: positions, first: 3 * j + k, step: 3 * J })),
      ...[0, 1, 2, 3].map((k) => ({ name: `${name}.q${AXES[k]}`, data: worldQuat, first: 4 * j + k, step: 4 * J })),
    ]),
    ...Array.from(contactJoints, (joint, i) => ({
      ...{ name: `${names[joint]}.contact`, data: contacts, first: i, step: contactJoints.length },
    })),
  ];
}

/** Facts that are the same in all rows: the skeleton, and the joints that stand for columns. */
export function besideTable(arrays: TakeArrays): Readonly<Record<string, unknown>> {
  const { names, parents, offsets, endNames, endParents, endOffsets, contactJoints, fps, carrier } = arrays;
  return {
    ...{ fps, names, columns: columnNames(arrays), parents: [...parents], offsets: rows(offsets, 3), root: carrier },
    ...{ end_names: endNames, end_parents: [...endParents], end_offsets: rows(endOffsets, 3) },
    contact_joints: [...contactJoints],
  };
}

/** Names of joints, made distinct by their indices, since files repeat names and leave them out. */
function columnNames({ names }: TakeArrays): readonly string[] {
  const counts = new Map<string, number>();
  for (const name of names) counts.set(name, (counts.get(name) ?? 0) + 1);
  return names.map((name, j) => (name !== '' && counts.get(name) === 1 ? name : `${name}#${j}`));
}

function rows(values: Floats, width: number): readonly (readonly number[])[] {
  const decimals = Array.from(values, shortest(values));
  return Array.from({ length: values.length / width }, (_, i) => decimals.slice(width * i, width * i + width));
}

/** From a value to the number whose decimals are enough to read it back: a single needs nine at most. */
export function shortest(values: Floats | Uint8Array): (value: number) => number {
  if (!(values instanceof Float32Array)) return (value) => value;
  return (value) => {
    const short = Number(value.toPrecision(7));
    return Math.fround(short) === value ? short : Number(value.toPrecision(9));
  };
}
