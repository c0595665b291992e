import { beforeAll, describe, expect, it } from 'vitest';
import { csvPieces } from '../../src/dataset/csv.ts';
import { FloatPool } from '../../src/dataset/float-pool.ts';
import { jsonPieces } from '../../src/dataset/json.ts';
import { parquetPieces } from '../../src/dataset/parquet.ts';
import { besideTable, tableColumns } from '../../src/dataset/table.ts';
import { takeOf } from '../../src/dataset/take.ts';
import { namedArrays, type TakeArrays, takeArrays } from '../../src/dataset/take-arrays.ts';
import { character } from '../helpers/builders.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';
import { readParquet } from './read-parquet.ts';

/** A person's legs, with two joints of one name, and so many frames that bits fill several bytes. */
function capture() {
  const turns = ['rz', 'rx', 'ry'] as const;
  const joints = [
    bvhJoint(-1, ['tx', 'ty', 'tz', ...turns], { name: 'Hips', offset: [0, 90, 0] }),
    ...['Left', 'Right'].flatMap((side, s) => {
      const hip = 1 + 4 * s;
      return ['UpLeg', 'Leg', 'Foot', 'Toe'].map((part, i) =>
        bvhJoint(i === 0 ? 0 : hip + i - 1, [...turns], {
          name: `${side}${part}`,
          offset: i === 0 ? [s ? -10 : 10, 0, 0] : [0, i === 3 ? 0 : -45, i === 3 ? 10 : 0],
          ...(i === 3 && { endSites: [[0, 0, 5] as const] }),
        }),
      );
    }),
    bvhJoint(0, [...turns], { name: 'Extra, "odd"' }),
    bvhJoint(0, [...turns], { name: 'Twin' }),
    bvhJoint(0, [...turns], { name: 'Twin' }),
  ];
  const rows = Array.from({ length: 37 }, (_, f) =>
    Array.from({ length: 6 + 3 * (joints.length - 1) }, (_, c) =>
      c === 1 ? 90 : f < 12 ? 0 : c === 0 ? 7 * f : (f * c) % 11,
    ),
  );
  return captureOf({ name: 'legs', joints }, rows);
}

let arrays: TakeArrays;
beforeAll(() => {
  const { skeleton, take } = capture();
  const own = character({
    skeleton,
    takes: take ? [take] : [],
    shownTake: 0,
    space: { up: 'y', unit: 'centimetres', lift: 0 },
  });
  arrays = takeArrays(takeOf(own, {}), new FloatPool('float32'));
});

const textOf = (pieces: Iterable<string>) => [...pieces].join('');
const cellOf = (name: string, row: number) => {
  const column = tableColumns(arrays).find((c) => c.name === name);
  if (!column) throw new Error(`There is no column ${name}.`);
  return column.data[column.first + row * column.step];
};

describe('a take as a table', () => {
  it('a take as a table has world positions and quaternions of each joint, and contacts of the feet', () => {
    const names = tableColumns(arrays).map(({ name }) => name);
    expect(names.slice(0, 8)).toEqual([
      'time',
      'Hips.px',
      'Hips.py',
      'Hips.pz',
      'Hips.qx',
      'Hips.qy',
      'Hips.qz',
      'Hips.qw',
    ]);
    expect(names.slice(-2)).toEqual(['LeftToe.contact', 'RightToe.contact']);
    expect(names.filter((name) => name.endsWith('px')).slice(-3)).toEqual([
      'Extra, "odd".px',
      'Twin#10.px',
      'Twin#11.px',
    ]);
    expect(cellOf('RightToe.pz', 36)).toBe(arrays.positions[3 * (36 * 12 + 8) + 2]);
    expect(cellOf('RightToe.qw', 36)).toBe(arrays.worldQuat[4 * (36 * 12 + 8) + 3]);
    expect(new Set(arrays.contacts)).toEqual(new Set([0, 1]));
    expect(besideTable(arrays)).toMatchObject({
      fps: 25,
      root: 0,
      contact_joints: [4, 8],
      end_names: ['LeftToe_end', 'RightToe_end'],
    });
  });

  it('CSV has every number of the table, to the last digit of single precision', () => {
    const [head, ...lines] = textOf(csvPieces(arrays)).trimEnd().split('\n');
    const columns = tableColumns(arrays);
    expect(head).toContain('Toe.qw,"Extra, ""odd"".px","Extra, ""odd"".py"');
    expect(lines.length).toBe(37);
    lines.forEach((line, row) => {
      const values = line.split(',').map(Number);
      columns.forEach(({ data, first, step, name }, c) => {
        const expected = data[first + row * step];
        expect(name === 'time' ? values[c] : Math.fround(values[c])).toBe(expected + 0);
      });
    });
  });

  it('Parquet has every number of the table, with its type, and the metadata', () => {
    const columns = tableColumns(arrays);
    const read = readParquet(Buffer.concat([...parquetPieces(columns, 37, { marrow: 'ä{}', more: '' })]));
    expect(read.metadata).toEqual({ marrow: 'ä{}', more: '' });
    expect(read.rowCount).toBe(37);
    expect(read.columns.map(({ name }) => name)).toEqual(columns.map(({ name }) => name));
    expect(new Set(read.columns.map(({ type }) => type))).toEqual(new Set(['DOUBLE', 'FLOAT', 'BOOLEAN']));
    read.columns.forEach(({ values }, c) => {
      const { data, first, step } = columns[c];
      expect(values).toEqual(Array.from({ length: 37 }, (_, r) => data[first + r * step]));
    });
  });

  it('JSON has every array, nested by its shape', () => {
    const read: Record<string, unknown> = JSON.parse(textOf(jsonPieces(namedArrays(arrays), { input: 'a' })));
    for (const { name, shape, type, data } of namedArrays(arrays)) {
      const nested = read[name];
      const flat = shape.length === 0 ? [nested] : [nested].flat(shape.length);
      const values =
        type === 'float' && data instanceof Float32Array
          ? flat.map((x) => Math.fround(Number(x)))
          : flat.map((x) => (type === 'bool' ? Number(x) : x));
      expect(values, name).toEqual(Array.from<number | string>(data).map((x) => (typeof x === 'number' ? x + 0 : x)));
      if (shape.length > 1) expect([Array.isArray(nested) && nested.length], name).toEqual([shape[0]]);
    }
    expect(read.meta).toEqual({ input: 'a' });
  });
});
