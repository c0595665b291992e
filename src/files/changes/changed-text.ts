/**
 * The changes of the page in a file: the file's own text with the changes (`merge.ts`), which reads as what saving
 * writes. Saving itself writes all lines in its own layout.
 */
import { newCharacter } from '../../edit/new-character.ts';
import { addPoses } from '../../edit/pose/library.ts';
import { asfReader } from '../../formats/acclaim/read-asf.ts';
import { stemOfName } from '../../formats/grammar.ts';
import { readWhole } from '../../formats/reader.ts';
import { Report } from '../../formats/report.ts';
import { EMPTY_DOCUMENT } from '../../model/document.ts';
import type { FileContent, SourceFile } from '../../model/files.ts';
import type { LineHunk } from '../../model/text-changes.ts';
import { amcTake } from '../acclaim.ts';
import { openFiles } from '../open/open-files.ts';
import { formatOf } from '../readers.ts';
import { outputOf, savedFileOf } from '../save/output.ts';
import { type Owned, ownedIn } from '../save/owned.ts';
import { posesByNames } from '../save/saved-poses.ts';
import { writeParts } from '../save/saving.ts';
import { writeFile } from '../writers.ts';
import { commonLines } from './line-diff.ts';
import { type MergedText, mergeChanges } from './merge.ts';
import { LineIds, lineMeaning, splitLines } from './text-lines.ts';

/**
 * The text of a file as the parts in it are now; without hunks, the very same text, if nothing has changed.
 *
 * @param owned the parts that are saved in it
 * @throws Error with a sentence, if the parts can't be saved in one file, or the text can't be read
 */
export function changedText(source: SourceFile, original: string, owned: readonly Owned[]): MergedText {
  const after = savedFileOf(writeParts(source.name, owned)).text;
  const before = rewritten(source, original, owned);
  if (before === undefined) throw new Error(`${source.name} has errors, so it can’t be compared with what is open.`);
  if (before === after) return { text: original, hunks: [] };
  // Defaults may not suit a joint of another type.
  for (const keepsDefaults of [true, false]) {
    const merged = mergeChanges(original, before, after, keepsDefaults);
    if (rewritten(source, merged.text, owned) === after) return merged;
  }
  return byValue(original, after);
}

/**
 * The text that results from reading a text and saving it again; undefined if it has errors. Equal for texts that say
 * the same.
 *
 * @param owned the parts that are saved in such a file
 */
export function rewritten(source: SourceFile, text: string, owned: readonly Owned[]): string | undefined {
  const value = contentOf(source, text, owned);
  if (!value) return undefined;
  if (value.kind === 'bvh') {
    const { document } = openFiles(EMPTY_DOCUMENT, [{ ...value, source }]);
    return savedFileOf(
      writeParts(
        source.name,
        ownedIn(document, source.path, () => []),
      ),
    ).text;
  }
  const content = value.kind === 'pose' ? inLibrary(value, owned) : value;
  const isWritten = writeFile(content, source.name) !== undefined;
  return isWritten ? savedFileOf(outputOf({ name: source.name, content: () => content })).text : undefined;
}

/** Undefined if it has errors. A motion of Acclaim is read with the skeleton of the character that has it. */
function contentOf({ name }: SourceFile, text: string, owned: readonly Owned[]): FileContent | undefined {
  const format = formatOf(name);
  if (format?.format === 'asf') {
    const { value: skeleton } = readWhole(asfReader(name), text);
    return skeleton && { kind: 'asf', skeleton };
  }
  if (format?.format !== 'amc') return readWhole<FileContent>(format?.reader(name) ?? NOTHING, text).value;
  const skeleton = owned[0]?.character.skeleton;
  const take = skeleton && amcTake(new TextEncoder().encode(text), new Report(name), stemOfName(name), skeleton);
  return take && { kind: 'amc', skeleton, take };
}

const NOTHING = { feed: () => undefined, end: () => ({ diagnostics: [] }) };

/** Poses as the joints of a library's character take them. */
function inLibrary(content: Extract<FileContent, { readonly kind: 'pose' }>, owned: readonly Owned[]): FileContent {
  const part = owned[0]?.part;
  if (part?.kind !== 'pose') return content;
  const { skeleton, morphs } = part.content;
  const character = { ...newCharacter('', ''), ...(skeleton && { skeleton }), morphs };
  const { poses = [] } = addPoses(character, content.poses);
  return { kind: 'pose', poses: posesByNames({ ...part.content, poses }) };
}

/** The written text, with the lines of the original that mean the same: of texts that can't be merged. */
function byValue(original: string, after: string): MergedText {
  const [own, written] = [splitLines(original).lines, splitLines(after).lines];
  const ids = new LineIds();
  const common = commonLines(ids.of(own.map(lineMeaning)), ids.of(written.map(lineMeaning)));
  const hunks: LineHunk[] = [];
  let newFrom = 0;
  for (let from = 0; from <= own.length; from++) {
    const oldFrom = from;
    while (from < own.length && common[from] < 0) from++;
    const newTo = from < own.length ? common[from] : written.length;
    if (from > oldFrom || newTo > newFrom) {
      hunks.push({ oldFrom: oldFrom + 1, oldTo: from + 1, newFrom: newFrom + 1, newTo: newTo + 1 });
    }
    newFrom = newTo + 1;
  }
  return { text: after, hunks };
}
