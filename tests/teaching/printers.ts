/** Prints numbers as students' programs do. */

/** How a number is written. */
export const NUMBER_STYLES: readonly ((value: number) => string)[] = [
  (value) => value.toFixed(6),
  (value) => String(Number(Math.fround(value).toPrecision(7))),
  (value) => value.toExponential(6).replace(/e([+-])(\d)$/, 'e$10$2'),
  (value) => `${value.toFixed(6)}f`,
];

type Style = (value: number) => string;

/** A printer of column-major matrices. */
export interface MatrixPrinter {
  readonly name: string;
  readonly order: 'row-major' | 'column-major';
  readonly numbers: 12 | 16;
  readonly extension: string;
  print(matrices: readonly Float64Array[], number: Style, names: readonly string[]): string;
}

const rowsOf = (m: Float64Array, count = 4) =>
  Array.from({ length: count }, (_, r) => [0, 1, 2, 3].map((c) => m[4 * c + r]));
const columnsOf = (m: Float64Array) => [0, 1, 2, 3].map((c) => Array.from(m.subarray(4 * c, 4 * c + 4)));
const line = (values: readonly number[], number: Style, between = ' ') => values.map(number).join(between);

function printer(
  name: string,
  [order, numbers]: readonly ['row-major' | 'column-major', 12 | 16],
  one: (m: Float64Array, number: Style, joint: number, name: string) => string,
  extension = 'txt',
  around: (all: string) => string = (all) => all,
): MatrixPrinter {
  return {
    name,
    order,
    numbers,
    extension,
    print: (matrices, number, names) => around(matrices.map((m, j) => one(m, number, j, names[j])).join('')),
  };
}

const BY_ROWS = ['row-major', 16] as const;
const BY_COLUMNS = ['column-major', 16] as const;
const THREE_ROWS = ['row-major', 12] as const;

export const MATRIX_PRINTERS: readonly MatrixPrinter[] = [
  printer('16 a line', BY_ROWS, (m, n) => `${line(rowsOf(m).flat(), n)}\n`),
  printer('12 a line', THREE_ROWS, (m, n) => `${line(rowsOf(m, 3).flat(), n)}\n`),
  printer('4 lines each', BY_ROWS, (m, n) =>
    rowsOf(m)
      .map((row) => `${line(row, n)}\n`)
      .join(''),
  ),
  printer(
    '3 lines each, with indices',
    THREE_ROWS,
    (m, n, j) =>
      `joint ${j}:\n${rowsOf(m, 3)
        .map((row) => `${line(row, n, '\t')}\n`)
        .join('')}`,
  ),
  printer(
    'glm::to_string',
    BY_COLUMNS,
    (m, n) =>
      `mat4x4(${columnsOf(m)
        .map((c) => `(${line(c, n, ', ')})`)
        .join(', ')})\n`,
  ),
  printer(
    'Eigen',
    BY_ROWS,
    (m, n) =>
      `${rowsOf(m)
        .map((row) => row.map((v) => n(v).padStart(12)).join(' '))
        .join('\n')}\n\n`,
  ),
  printer(
    'numpy',
    BY_ROWS,
    (m, n) =>
      `[[${rowsOf(m)
        .map((row) => line(row, n))
        .join(']\n [')}]]\n`,
  ),
  printer(
    'JavaScript',
    BY_COLUMNS,
    (m, n) =>
      `Float32Array(16) [\n  ${columnsOf(m)
        .map((c) => line(c, n, ', '))
        .join(',\n  ')}\n]\n`,
  ),
  printer('named rows', BY_ROWS, (m, n, _, name) => `${name}: ${line(rowsOf(m).flat(), n)}\n`),
  printer('by columns, in one line', BY_COLUMNS, (m, n) => `${line(columnsOf(m).flat(), n)} `),
  printer(
    'CSV',
    BY_ROWS,
    (m, n, j) => `${j},${line(rowsOf(m).flat(), n, ',')}\n`,
    'csv',
    (all) =>
      `index,${'abcd'.replace(/./g, (_, r: number) =>
        [0, 1, 2, 3]
          .map((c) => `m${r}${c}`)
          .join(',')
          .concat(r < 3 ? ',' : ''),
      )}\n${all}`,
  ),
  printer(
    'Unity',
    BY_ROWS,
    (m, n) =>
      `${rowsOf(m)
        .map((row) => line(row, n, '\t'))
        .join('\n')}\n\n`,
  ),
  printer(
    'System.Numerics',
    BY_ROWS,
    (m, n) =>
      `{ ${rowsOf(m)
        .map((row, r) => `{${row.map((v, c) => `M${r + 1}${c + 1}:${n(v)}`).join(' ')}}`)
        .join(' ')} }\n`,
  ),
];

/** A printer of x y z per point. */
export interface PointPrinter {
  readonly name: string;
  readonly extension: string;
  print(points: Float64Array, number: Style, kind: 'vertices' | 'normals' | 'positions'): string;
}

const each = (points: Float64Array, one: (point: readonly number[], index: number) => string) =>
  Array.from({ length: points.length / 3 }, (_, v) => one(Array.from(points.subarray(3 * v, 3 * v + 3)), v));

const isVertices = (kind: string) => kind === 'vertices';

export const POINT_PRINTERS: readonly PointPrinter[] = [
  { name: 'x y z', extension: 'txt', print: (p, n, kind) => `${kind}\n${each(p, (v) => line(v, n)).join('\n')}\n` },
  {
    name: 'parentheses',
    extension: 'log',
    print: (p, n, kind) => `# ${kind}\n${each(p, (v) => `(${line(v, n, ', ')})`).join('\n')}\n`,
  },
  {
    name: 'indices',
    extension: 'txt',
    print: (p, n, kind) => `${kind}:\n${each(p, (v, i) => `${i}: ${line(v, n)}`).join('\n')}\n`,
  },
  {
    name: 'backwards, with indices',
    extension: 'csv',
    print: (p, n, kind) =>
      `${kind}\n${each(p, (v, i) => `${i},${line(v, n, ',')}`)
        .reverse()
        .join('\n')}\n`,
  },
  {
    name: 'glm::to_string',
    extension: 'txt',
    print: (p, n, kind) => `${kind}\n${each(p, (v) => `vec3(${line(v, n, ', ')})`).join('\n')}\n`,
  },
  {
    name: 'numpy',
    extension: 'txt',
    print: (p, n, kind) => `${kind}\n[[${each(p, (v) => line(v, n)).join(']\n [')}]]\n`,
  },
  {
    name: 'JavaScript objects',
    extension: 'txt',
    print: (p, n, kind) => `${kind}\n${each(p, ([x, y, z]) => `{ x: ${n(x)}, y: ${n(y)}, z: ${n(z)} }`).join('\n')}\n`,
  },
  {
    name: 'OBJ',
    extension: 'obj',
    print: (p, n, kind) =>
      `o mine\n${each(p, (v) => `${kind === 'normals' ? 'vn' : 'v'} ${line(v, n)}`).join('\n')}\nf 1 2 3\n`,
  },
  {
    name: 'PLY',
    extension: 'ply',
    print: (p, n, kind) =>
      `ply\nformat ascii 1.0\nelement vertex ${p.length / 3}\n${['x', 'y', 'z'].map((axis) => `property float ${isVertices(kind) || kind === 'positions' ? '' : 'n'}${axis}\n`).join('')}end_header\n${each(p, (v) => line(v, n)).join('\n')}\n`,
  },
  {
    name: 'JSON',
    extension: 'json',
    print: (p, _, kind) => JSON.stringify({ [kind]: each(p, (v) => JSON.stringify(v)).map((v) => JSON.parse(v)) }),
  },
];
