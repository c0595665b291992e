/**
 * What has to hold for any input of a reader:
 *
 *     crash      it returns a result, or an error in words; it throws nothing
 *     result     there is a value, or an error, and never both
 *     told       messages have words, places in the file, and excerpts that can be shown
 *     pieces     in pieces of any size it reads the same, to the last message
 *     finite     what is accepted has no NaN and no infinity, and its indices are of something
 *     written    written and read again it is the same model, and written once more the same bytes
 *     slow       it takes less than a second
 *     memory     it takes less than ten times the file, a megabyte, and what its joints need (`memory.ts`)
 */
import { isDeepStrictEqual } from 'node:util';
import { recordsIn } from '../../../src/cli/export/records.ts';
import { type Format, formatOf } from '../../../src/files/readers.ts';
import { writeFile } from '../../../src/files/writers.ts';
import { isWorthDiagnosing } from '../../../src/formats/diagnose/diagnose.ts';
import type { ReadResult } from '../../../src/formats/reader.ts';
import { unzip } from '../../../src/formats/unzip.ts';
import { mostNumbers } from '../../../src/import/budget.ts';
import type { Diagnostic } from '../../../src/model/diagnostic.ts';
import type { FileContent, WholeCharacter } from '../../../src/model/files.ts';
import { arePoints } from '../../../src/model/skeleton/joint-types.ts';
import type { ListedTake } from '../../../src/review/list.ts';
import { isTakeList, readList } from '../../../src/review/read-list.ts';
import { listAsCsv, listAsJson } from '../../../src/review/write-list.ts';
import { parseSettings } from '../../../src/ui/state/settings.ts';
import { ODD_ASF } from '../../helpers/acclaim.ts';
import { notFinite } from './finite.ts';
import type { Input } from './inputs.ts';
import { type Held, heldBy, mostBytes, openedBy, taken, takenExactly } from './memory.ts';
import { cutsOf, hashOf } from './pieces.ts';

export interface Fault {
  readonly kind: 'crash' | 'result' | 'told' | 'pieces' | 'finite' | 'written' | 'slow' | 'memory';
  /** A sentence. */
  readonly what: string;
}

const NOTHING: Held = { things: 0, rows: 0 };
const SLOW_MS = 1000;
/** The places of problems are looked for in one of so many files, since they are read again a dozen times for it. */
const ONE_IN = 16;

type Told = (kind: Fault['kind'], what: string) => void;

/**
 * Everything that gives way. The same for the same input, but for times.
 * @param isWhole false: it is only read, so of the list above `crash`, `result`, `told` and `slow`, in a tenth of the time
 */
export async function faultsOf(input: Input, isWhole = true): Promise<readonly Fault[]> {
  const faults: Fault[] = [];
  const tell: Told = (kind, what) => void faults.push({ kind, what });
  try {
    await (isWhole ? check(input, tell) : checkRead(input, tell));
  } catch (error) {
    faults.push({ kind: 'crash', what: error instanceof Error ? (error.stack ?? error.message) : String(error) });
  }
  return faults;
}

/** Only reads. What has no reader is checked as a whole, which takes as little. */
async function checkRead(input: Input, tell: Told): Promise<void> {
  const { subject, bytes } = input;
  const format = formatOf(`x.${subject}`);
  if (!format) return await check(input, tell);
  const begun = performance.now();
  const { imports } = format;
  const imported = await imports?.({ fileName: `x.${subject}`, bytes, ...BESIDE });
  const result = imported && !imported.isOther ? imported : read(format, `x.${subject}`, bytes, []);
  checkTold(result, bytes, tell);
  // What was slow may have been so by chance, which the whole check finds out.
  if (performance.now() - begun > SLOW_MS) await check(input, tell);
}

async function check(input: Input, tell: Told): Promise<void> {
  const { subject, bytes } = input;
  const format = formatOf(`x.${subject}`);
  if (subject === 'zip') await checkZip(input, tell);
  else if (subject === 'settings.json') await checkSettings(input, tell);
  else if (subject === 'manifest.ndjson') await measured(input, () => recordsIn(textOf(bytes)), tell);
  else if (subject === 'review.csv' || subject === 'review.json') await checkList(input, tell);
  else if (format?.imports) await checkImport(input, format, format.imports, tell);
  else if (format) await checkFormat(input, format, tell);
}

const textOf = (bytes: Uint8Array) => new TextDecoder().decode(bytes);

/** Reads, and tells what took too long or too much. */
async function measured<T>(
  { bytes }: Input,
  read: () => T | Promise<T>,
  tell: Told,
  heldOf: (result: T) => Held = () => NOTHING,
): Promise<T> {
  const begun = performance.now();
  const { result, most: upTo } = await taken(read);
  if (performance.now() - begun > SLOW_MS) {
    const ms = Math.min(await cpuMs(read), await cpuMs(read));
    if (ms > SLOW_MS) tell('slow', `${Math.round(ms)} ms for ${bytes.length} bytes`);
  }
  const most = mostBytes(bytes.length, heldOf(result));
  if (upTo > most) {
    const exact = await takenExactly(read);
    const of = `of ${bytes.length} bytes, ${(exact.peak / bytes.length).toFixed(1)} times as much`;
    if (exact.kept > most) tell('memory', `${exact.kept} bytes kept ${of}`);
    else if (exact.peak > most) tell('memory', `${exact.peak} bytes at peak ${of}`);
  }
  return result;
}

/** On a busy machine, a second passes in which nothing is read. */
async function cpuMs(read: () => unknown): Promise<number> {
  const before = process.cpuUsage();
  await read();
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1000;
}

async function checkFormat(input: Input, format: Format, tell: Told): Promise<void> {
  const { subject, bytes } = input;
  const name = `x.${subject}`;
  const whole = await measured(
    input,
    () => read(format, name, bytes, []),
    tell,
    ({ value }) => (value ? heldBy(value, bytes) : openedBy(bytes)),
  );
  checkTold(whole, bytes, tell);
  for (const cuts of cutsOf(bytes)) {
    const inPieces = read(format, name, bytes, cuts);
    if (isDeepStrictEqual(inPieces, whole)) continue;
    const other = isDeepStrictEqual(inPieces.diagnostics, whole.diagnostics) ? 'another model' : 'other messages';
    tell('pieces', `${other} with ${cuts.length} cuts: ${firstDifference(whole.diagnostics, inPieces.diagnostics)}`);
  }
  if (format.diagnose && hashOf(bytes) % ONE_IN === 0 && isWorthDiagnosing(whole.diagnostics, bytes.length)) {
    const { diagnose } = format;
    const begun = performance.now();
    const diagnostics = diagnose(name, bytes, whole.diagnostics);
    checkTold({ ...whole, diagnostics }, bytes, tell);
    if (performance.now() - begun > SLOW_MS) {
      const ms = await cpuMs(() => diagnose(name, bytes, whole.diagnostics));
      if (ms > SLOW_MS) tell('slow', `${Math.round(ms)} ms to find the places of problems in ${bytes.length} bytes`);
    }
  }
  if (whole.value) checkContent(whole.value, name, tell);
}

function firstDifference(a: readonly Diagnostic[], b: readonly Diagnostic[]): string {
  const at = a.findIndex((each, i) => !isDeepStrictEqual(each, b[i]));
  return `${JSON.stringify(a[at])} and ${JSON.stringify(b[at])}`;
}

function read(format: Format, name: string, bytes: Uint8Array, cuts: readonly number[]): ReadResult<FileContent> {
  const reader = format.reader(name, bytes.length);
  let from = 0;
  for (const cut of [...cuts, bytes.length]) {
    const piece = bytes.slice(from, cut);
    reader.feed(piece);
    // As a stream may do.
    piece.fill(0x7b);
    from = cut;
  }
  return reader.end();
}

function checkTold({ value, diagnostics }: ReadResult<unknown>, bytes: Uint8Array, tell: Told): void {
  if ((value === undefined) !== diagnostics.some(({ severity }) => severity === 'error')) {
    tell('result', value === undefined ? 'no value, and no error' : 'a value, and an error');
  }
  if (diagnostics.length === 0) return;
  const lines = textOf(bytes).split(/\r*\n|\r/).length;
  for (const { message, line, excerpt, code, assumed } of diagnostics) {
    if (message === '' || message.length > 1000 || /undefined|\[object|NaN of/.test(message.replace(/"[^"]*"/g, ''))) {
      tell('told', `${code}: ${message}`);
    }
    if ((assumed?.length ?? 0) > 1000) tell('told', `${code}: ${assumed}`);
    if (line > lines) tell('told', `${code} in line ${line} of ${lines}`);
    if (excerpt && (excerpt.text.length > 200 || excerpt.caret > excerpt.text.length)) tell('told', `${code}: excerpt`);
  }
}

function checkContent(value: FileContent, name: string, tell: Told): void {
  // Other programs print NaN, which is what is to be seen.
  const path = value.kind === 'dump' ? undefined : notFinite(value);
  if (path) tell('finite', path);
  checkWritten(value, name, tell);
}

/** Nothing for content that is only read. @param isSame whether the model must be the same, not only its text */
function checkWritten(value: FileContent, name: string, tell: Told, isSame = true): void {
  const first = written(value, name);
  if (!first) return;
  const format = formatOf(name);
  const again = format && read(format, name, first.bytes, []);
  if (!again?.value) {
    tell('written', `what is written has errors: ${JSON.stringify(again?.diagnostics.slice(0, 2))}`);
    return;
  }
  // What a format can't hold is told.
  if (isSame && first.diagnostics.length === 0 && !isDeepStrictEqual(again.value, value)) {
    tell('written', 'another model after writing and reading');
  }
  const second = written(again.value, name);
  if (!second || Buffer.compare(first.bytes, second.bytes) !== 0) tell('written', 'other bytes when written once more');
}

function written(value: FileContent, name: string) {
  const result = writeFile(value, name);
  if (!result) return undefined;
  if ('text' in result) return { bytes: new TextEncoder().encode(result.text), diagnostics: result.diagnostics };
  const bytes = new Uint8Array(Buffer.concat([...result.pieces]));
  return { bytes, diagnostics: result.diagnostics() };
}

const ODD_SKELETON = new TextEncoder().encode(ODD_ASF);

/** A skeleton that motions of Acclaim belong to; other files find nothing beside them. */
const BESIDE = {
  near: (extension: string) => (extension === 'asf' ? ['x.asf'] : []),
  beside: async (path: string) =>
    path === 'x.asf' ? { bytes: ODD_SKELETON, source: { name: path, path, bytes: ODD_SKELETON.length } } : undefined,
};

async function checkImport(
  { subject, bytes }: Input,
  format: Format,
  imports: NonNullable<Format['imports']>,
  tell: Told,
): Promise<void> {
  const fileName = `x.${subject}`;
  const given = { fileName, bytes, ...BESIDE };
  const { value, diagnostics, isOther } = await measured(
    { subject, bytes },
    () => imports(given),
    tell,
    () => ({
      ...NOTHING,
      numbers: mostNumbers(bytes.length),
    }),
  );
  if (isOther) return checkFormat({ subject, bytes }, format, tell);
  checkTold({ ...(value && { value }), diagnostics }, bytes, tell);
  if (value && value.kind !== 'character') {
    const path = notFinite(value);
    if (path) tell('finite', path);
    const first = path ? undefined : written(value, fileName);
    const again = first && (await imports({ ...given, bytes: first.bytes }));
    if (again && !again.value)
      tell('written', `what is written has errors: ${JSON.stringify(again.diagnostics.slice(0, 2))}`);
    return;
  }
  for (const character of value?.characters ?? []) {
    checkIndices(character, tell);
    const path = notFinite(character);
    if (path) {
      tell('finite', path);
      continue;
    }
    const { skeleton, skins, morphs, takes } = character;
    if (arePoints(skeleton)) {
      await checkPoints({ kind: 'trc', capture: { skeleton, take: takes[0] } }, tell);
      continue;
    }
    checkWritten({ kind: 'skel', skeletons: [skeleton] }, 'x.skel', tell, false);
    for (const skin of skins) checkWritten({ kind: 'skin', skin }, 'x.skin', tell, false);
    for (const morph of morphs) checkWritten({ kind: 'morph', morph }, 'x.morph', tell, false);
    for (const take of takes) checkWritten({ kind: 'anim', take }, 'x.anim', tell, false);
  }
}

/** Points of other files are written to a `.trc`. */
async function checkPoints(value: FileContent, tell: Told): Promise<void> {
  const first = written(value, 'x.trc');
  const again = first && (await formatOf('x.trc')?.imports?.({ fileName: 'x.trc', bytes: first.bytes, ...BESIDE }));
  if (!again?.value) tell('written', `what is written has errors: ${JSON.stringify(again?.diagnostics.slice(0, 2))}`);
}

function checkIndices({ skeleton, skins }: WholeCharacter, tell: Told): void {
  for (const { positions, triangles, attachments, bindings } of skins) {
    const vertices = positions.length / 3;
    if (!triangles.every((vertex) => vertex < vertices)) tell('finite', 'a triangle of no vertex');
    const bound = Math.min(bindings.length / 16, skeleton.joints.length);
    if (!(attachments?.joints.every((joint) => joint < bound) ?? true)) tell('finite', 'an attachment of no joint');
  }
}

async function checkZip(input: Input, tell: Told): Promise<void> {
  await measured(
    input,
    () => {
      try {
        return unzip(input.bytes, () => true).entries.length;
      } catch (error) {
        // A sentence; anything else is a failure of the program.
        if (error instanceof Error && !(error instanceof TypeError)) return error.message;
        throw error;
      }
    },
    tell,
  );
}

async function checkSettings(input: Input, tell: Told): Promise<void> {
  const text = textOf(input.bytes);
  const settings = await measured(input, () => parseSettings(text), tell);
  const path = notFinite(settings);
  if (path) tell('finite', path);
  const kept = JSON.stringify(settings);
  if (JSON.stringify(parseSettings(kept)) !== kept) tell('written', 'other settings when kept');
}

async function checkList(input: Input, tell: Told): Promise<void> {
  const text = textOf(input.bytes);
  isTakeList(text);
  const { takes, diagnostics } = await measured(
    input,
    () => readList(text, `x.${input.subject}`),
    tell,
    // A bracket of JSON is a thing, whether it is a take or not.
    (list) => ({
      things: Math.max(list.takes.length, input.subject === 'review.json' ? openedBy(input.bytes).things : 0),
      rows: 0,
    }),
  );
  checkTold({ ...(takes.length > 0 && { value: takes }), diagnostics }, input.bytes, tell);
  const path = notFinite(takes);
  if (path) tell('finite', path);
  if (takes.length === 0) return;
  for (const write of [listAsCsv, listAsJson]) {
    const first = write(takes);
    const again = readList(first, 'x');
    const held = write === listAsJson ? takes : takes.map(asCsvHolds);
    if (!isDeepStrictEqual(again.takes, held)) tell('written', `other takes after ${write.name}`);
    else if (write(again.takes) !== first) tell('written', `another text after ${write.name}`);
  }
}

/** An empty cell says no more than that no flags are known, and a semicolon comes between two of them. */
function asCsvHolds({ flags, ...rest }: ListedTake): ListedTake {
  return flags?.length ? { ...rest, flags: flags.map((flag) => flag.replaceAll(';', ',')) } : rest;
}
