/** Dumps as meshes: positions and normals of vertices in a Wavefront OBJ or an ascii PLY; all else is skipped. */
import { NO_PLACE } from '../places.ts';
import type { Report } from '../report.ts';
import { Blocks } from './blocks.ts';
import { linesOf, numbersIn, timeIn } from './numbers.ts';

/** `v x y z` and `vn x y z`; further numbers of a line, such as colours, are skipped. */
export function readObj(text: string, blocks: Blocks, report: Report): void {
  const vertices = new Blocks();
  const normals = new Blocks();
  vertices.say({ holds: 'vertices' });
  normals.say({ holds: 'normals' });
  let line = 0;
  for (const row of linesOf(text)) {
    line++;
    const words = row.trim().split(/\s+/);
    const into = words[0] === 'v' ? vertices : words[0] === 'vn' ? normals : undefined;
    if (!into) {
      const time = /^[#o]/.test(words[0]) ? timeIn(row) : undefined;
      if (time !== undefined) for (const each of [vertices, normals]) each.say({ time });
      continue;
    }
    const numbers = numbersIn(words.slice(1, 4).join(' '));
    if (numbers?.length === 3) into.row(numbers, line);
    else shortRow(report, words[0], line);
  }
  for (const each of [vertices, normals]) {
    each.close();
    blocks.done.push(...each.done);
  }
}

function shortRow(report: Report, keyword: string, line: number): void {
  const place = report.hasRoom('error') ? { line, column: 1 } : NO_PLACE;
  report.error('row-incomplete', `Expected 3 numbers after "${keyword}", found fewer.`, place);
}

interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: string[];
}

/** The element `vertex`: its properties x y z and nx ny nz. */
export function readPly(text: string, blocks: Blocks, report: Report): void {
  const lines = linesOf(text);
  const elements: Element[] = [];
  // The first is `ply`.
  lines.next();
  let line = 1;
  const nextLine = () => {
    line++;
    return lines.next();
  };
  for (let next = nextLine(); !next.done && next.value.trim() !== 'end_header'; next = nextLine()) {
    const words = next.value.trim().split(/\s+/);
    const [word, second, third] = words;
    if (word === 'comment' || word === 'obj_info') {
      const time = timeIn(next.value);
      if (time !== undefined) blocks.say({ time });
    } else if (word === 'format' && second !== 'ascii') {
      report.error('ply-binary', `Expected "format ascii 1.0", found "format ${second}".`, { line, column: 1 });
      return;
    } else if (word === 'element') elements.push({ name: second, count: Number(third), properties: [] });
    else if (word === 'property') elements.at(-1)?.properties.push(words.at(-1) ?? '');
  }
  const { time } = blocks.heading;
  const kinds = [
    { holds: 'vertices', names: ['x', 'y', 'z'] },
    { holds: 'normals', names: ['nx', 'ny', 'nz'] },
  ] as const;
  const into = kinds.map(({ holds }) => {
    const own = new Blocks();
    own.say({ holds, time });
    return own;
  });
  for (const { name, count, properties } of elements) {
    for (let i = 0; i < count; ) {
      const next = nextLine();
      if (next.done) break;
      if (next.value.trim() === '') continue;
      i++;
      if (name !== 'vertex') continue;
      const numbers = numbersIn(next.value);
      kinds.forEach(({ names }, k) => {
        const columns = names.map((each) => properties.indexOf(each));
        if (columns.some((column) => column < 0)) return;
        if (numbers && columns.every((column) => column < numbers.length))
          into[k].row(
            columns.map((c) => numbers[c]),
            line,
          );
        else {
          const message = `Expected ${properties.length} numbers for a vertex, found ${numbers?.length ?? 'something else'}.`;
          report.error('row-incomplete', message, { line, column: 1 });
        }
      });
    }
  }
  for (const each of into) {
    each.close();
    blocks.done.push(...each.done);
  }
}
