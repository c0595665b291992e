/**
 * `.skin`: a mesh, its attachments to joints, and the joints' matrices when it was bound.
 *
 *     skin = { positions N "{" { x y z } "}"  |  normals N "{" { x y z } "}"  |  texcoords N "{" { u v } "}"
 *            | skinweights N "{" { k j0 w0 … } "}"  |  triangles M "{" { a b c } "}"
 *            | bindings J "{" { matrix [INDEX] "{" a b c d "}" } "}"
 *            | material [NAME] "{" { texture FILE | color r g b } "}" }    in any order
 *
 * A matrix lists its columns a b c d, three numbers each. What involves several blocks is checked at the end. Several
 * materials, each followed by its triangles, and colours are an extension: see `surfaces.ts`.
 */
import { isSingular } from '../../math/mat4.ts';
import { areaNormal } from '../../math/triangle.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { Material, Skin } from '../../model/skin.ts';
import {
  blockHead,
  braceTooMany,
  checkCount,
  checkRows,
  countAndBrace,
  type GrammarPart,
  NumberList,
  namedHead,
  numbers,
  rows,
  skipStrange,
  stemOfName,
  warnRepeated,
} from '../grammar.ts';
import { NO_PLACE, WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { AttachmentSink, TriangleSink } from './sinks.ts';
import { Surfaces } from './surfaces.ts';

/** A reader for a `.skin`. */
export function skinReader(fileName: string): Reader<Skin> {
  return grammarReader(fileName, skinFile);
}

/** Reads a whole `.skin`. */
export function readSkin(bytes: Uint8Array | string, fileName: string): ReadResult<Skin> {
  return readWhole(skinReader(fileName), bytes);
}

const BLOCKS = new Set(['positions', 'normals', 'texcoords', 'skinweights', 'triangles', 'bindings', 'material']);
const IN_BINDINGS = new Set(['matrix']);
const KEYWORDS = new Set([...BLOCKS, ...IN_BINDINGS, 'texture', 'color']);

/** A name with blanks ends with one of these. */
const TEXTURE = /\.(bmp|png|jpe?g|webp|gif|tga|tiff?)$/i;

/** A block with a row per vertex, and its place, in case it does not fit. */
interface Block {
  readonly values: Float64Array;
  readonly place: Mark;
}

interface Parts {
  positions?: Block;
  normals?: Block;
  texcoords?: Block;
  attachments?: AttachmentSink;
  attachmentsAt?: Mark;
  triangles?: TriangleSink;
  bindings?: Float64Array;
  readonly surfaces: Surfaces;
  /** So far. */
  materials: number;
}

function* skinFile(t: Tokens): GrammarPart<Skin> {
  const parts: Parts = { surfaces: new Surfaces(), materials: 0 };
  for (;;) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    if (kind === '}') braceTooMany(t);
    else yield* block(t, parts);
  }
  return skinOf(t, parts);
}

function* block(t: Tokens, parts: Parts): GrammarPart<void> {
  const word = t.keyword();
  switch (word) {
    case 'positions':
    case 'normals':
    case 'texcoords': {
      if (parts[word]) warnRepeated(t, word);
      const place = t.mark();
      parts[word] = { values: yield* rows(t, word, word === 'texcoords' ? 2 : 3, KEYWORDS), place };
      return;
    }
    case 'skinweights':
      if (parts.attachments) warnRepeated(t, word);
      parts.attachmentsAt = t.mark();
      parts.attachments = yield* skinweights(t);
      return;
    case 'triangles':
      yield* triangles(t, parts);
      return;
    case 'bindings':
      if (parts.bindings) warnRepeated(t, word);
      parts.bindings = yield* bindings(t);
      return;
    case 'material':
      parts.surfaces.beginMaterial(t);
      parts.surfaces.endMaterial(yield* material(t, parts.materials++));
      return;
    default:
      yield* skipStrange(t, 'a .skin file', 'positions, normals, skinweights, triangles, bindings or material', BLOCKS);
  }
}

function* skinweights(t: Tokens): GrammarPart<AttachmentSink> {
  const declared = yield* countAndBrace(t, 'skinweights', KEYWORDS);
  const sink = new AttachmentSink(declared.count ?? 0);
  yield* t.numbers(sink, 'skinweights', KEYWORDS);
  sink.tell(t);
  if (t.kind !== '}') return sink;
  if (sink.missing > 0) {
    const missing = Number.isFinite(sink.missing) ? `${sink.missing} numbers` : 'more than 4294967295 attachments';
    const message = `The last row of skinweights is ${missing} short: a row is a count, then a joint and a weight for each.`;
    t.error('row-incomplete', message);
  } else checkCount(t, 'skinweights', declared, sink.rows);
  return sink;
}

/** Indices continue through all blocks. */
function* triangles(t: Tokens, parts: Parts): GrammarPart<void> {
  const { surfaces, positions } = parts;
  surfaces.beginTriangles(t);
  const declared = yield* countAndBrace(t, 'triangles', KEYWORDS);
  parts.triangles ??= new TriangleSink(positions && Math.floor(positions.values.length / 3));
  const sink = parts.triangles;
  const before = sink.found;
  sink.begin(t, 3 * (declared.count ?? 0));
  yield* t.numbers(sink, 'triangles', KEYWORDS);
  sink.tell(t);
  const found = sink.found - before;
  checkRows(t, 'triangles', 3, declared, found);
  surfaces.endTriangles(Math.floor(found / 3));
}

/** `J { matrix { a b c d } … }` */
function* bindings(t: Tokens): GrammarPart<Float64Array> {
  const opened = t.mark();
  const declared = yield* countAndBrace(t, 'bindings', KEYWORDS);
  const all: Float64Array[] = [];
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the bindings');
    if (t.keyword() === 'matrix') all.push(yield* matrix(t, all.length));
    else if (KEYWORDS.has(t.keyword())) {
      t.braceMissing('bindings');
      break;
    } else yield* skipStrange(t, 'the bindings', 'matrix', IN_BINDINGS);
  }
  if (t.kind === '}') checkCount(t, 'bindings', declared, all.length);
  const flat = new Float64Array(16 * all.length);
  all.forEach((m, i) => {
    flat.set(m, 16 * i);
  });
  return flat;
}

/** `[INDEX] { a b c d }`, the columns, three numbers each. The identity after an error. */
function* matrix(t: Tokens, joint: number): GrammarPart<Float64Array> {
  const what = `the binding of joint ${joint}`;
  const place = t.mark();
  const { errorCount } = t.report;
  yield* blockHead(t, 'matrix', joint, KEYWORDS);
  const sink = new NumberList(t, 12);
  yield* t.numbers(sink, what, KEYWORDS);
  const m = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  if (sink.count !== 12) {
    if (t.kind === '}') {
      t.error('matrix-size', `Expected 12 numbers for ${what}, four columns of three, found ${sink.count}.`);
    }
    return m;
  }
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 3; row++) m[4 * column + row] = sink.values[3 * column + row];
  }
  if (t.report.errorCount === errorCount && isSingular(m)) {
    const message = `The matrix of ${what} has no inverse: its columns are coplanar, or one of them is 0.`;
    t.report.error('binding-singular', message, t.placeOf(place));
  }
  t.forget(place);
  return m;
}

/** `[NAME] { texture FILE  color r g b }`, either or both. */
function* material(t: Tokens, index: number): GrammarPart<Material> {
  const opened = t.mark();
  const name = yield* namedHead(t, 'material', index, KEYWORDS);
  let texture: string | undefined;
  let color: Vec3 | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the material');
    const word = t.keyword();
    if (word === 'texture') {
      if ((yield* t.next()) === 'word') texture = yield* t.file(TEXTURE, KEYWORDS);
      else {
        t.error('file-expected', `Expected a file name after texture, found ${t.found()}.`);
        t.again();
      }
    } else if (word === 'color') color = yield* colorOf(t);
    else if (KEYWORDS.has(word)) {
      t.braceMissing('the material');
      break;
    } else yield* skipStrange(t, 'a material', 'texture or color');
  }
  t.forgetFrom(opened);
  return { name, ...(texture !== undefined && { texture }), ...(color && { color }) };
}

/** `r g b`, kept as written. */
function* colorOf(t: Tokens): GrammarPart<Vec3> {
  const place = t.mark();
  const [r, g, b] = yield* numbers(t, 3, (i) => `the ${['red', 'green', 'blue'][i]} of color, from 0 to 1`, KEYWORDS);
  const wrong = [r, g, b].find((value) => !(value >= 0 && value <= 1));
  if (wrong === undefined) t.forget(place);
  else {
    const message = `Expected red, green and blue from 0 to 1 after color, found ${wrong}.`;
    t.report.warn('color-out-of-range', message, t.placeOf(place, 'warning'), 'drawn as the nearest colour');
  }
  return [r, g, b];
}

/** After the file is read: checks that its blocks fit together. */
function skinOf(t: Tokens, parts: Parts): Skin {
  const { report } = t;
  const { attachments, triangles, bindings = new Float64Array(0) } = parts;
  const positions = parts.positions?.values ?? new Float64Array(0);
  const vertices = Math.floor(positions.length / 3);
  if (vertices === 0) {
    report.error(
      'vertex-missing',
      'Expected positions of at least one vertex, found none.',
      parts.positions ? t.placeOf(parts.positions.place) : WHOLE_FILE,
    );
  }
  const normals = fitting(t, parts.normals, 3, vertices, 'normals');
  if (!normals && vertices > 0) {
    report.info(
      'normals-computed',
      'Found no normals; they are computed from the triangles.',
      NO_PLACE,
      'area-weighted',
    );
  }
  const corners = triangles?.all() ?? new Uint32Array(0);
  if (normals && !report.hasErrors) tellWinding(t, positions, normals, corners);
  const texcoords = fitting(t, parts.texcoords, 2, vertices, 'texcoords');
  triangles?.tellOutOfRange(t, vertices, parts.positions?.place);
  attachments?.tellOutOfRange(t, bindings.length / 16);
  // A truncated row is an error already, so the count of rows is not reliable.
  const misfits = attachments && attachments.missing === 0 && attachments.rows !== vertices && vertices > 0;
  if (misfits && parts.attachmentsAt) {
    const message = `Expected skinweights for ${vertices} vertices, found ${attachments.rows}.`;
    const assumed = attachments.rows < vertices ? 'the others have no attachments' : `used the first ${vertices}`;
    report.warn('skinweights-count', message, t.placeOf(parts.attachmentsAt), assumed);
  }
  return {
    name: stemOfName(t.fileName),
    positions,
    ...(normals && { normals }),
    ...(texcoords && { texcoords }),
    ...(attachments && { attachments: attachments.all(vertices) }),
    triangles: corners,
    surfaces: parts.surfaces.end(t),
    bindings,
  };
}

/** One in so many triangles is a fold of a fine mesh. */
const FEW_IN = 1000;

/** Says how many triangles have their normals on the side from which their vertices run clockwise. */
function tellWinding(t: Tokens, positions: Float64Array, normals: Float64Array, triangles: Uint32Array): void {
  const area = new Float64Array(3);
  let against = 0;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const a = 3 * triangles[i];
    const b = 3 * triangles[i + 1];
    const c = 3 * triangles[i + 2];
    areaNormal(positions, a, b, c, area);
    const x = area[0] * (normals[a] + normals[b] + normals[c]);
    const y = area[1] * (normals[a + 1] + normals[b + 1] + normals[c + 1]);
    const z = area[2] * (normals[a + 2] + normals[b + 2] + normals[c + 2]);
    if (x + y + z < 0) against++;
  }
  const all = Math.floor(triangles.length / 3);
  if (against === 0 || against * FEW_IN < all) return;
  const message = `Of ${all} triangles, ${against} ${against === 1 ? 'is' : 'are'} wound against their normals.`;
  t.report.info('triangles-wound', message, NO_PLACE, 'drawn from both sides, shaded by the normals');
}

/** A block if it has a row for each vertex. */
function fitting(t: Tokens, block: Block | undefined, width: number, vertices: number, what: string) {
  if (!block || block.values.length === width * vertices) return block?.values;
  // Incomplete rows are an error already.
  if (block.values.length % width === 0 && vertices > 0) {
    const message = `Expected ${what} for ${vertices} vertices, found ${block.values.length / width}.`;
    t.report.warn(`${what}-count`, message, t.placeOf(block.place), 'ignored');
  }
  return undefined;
}
