/**
 * The changes of the page in a file: the file's own text with the changes (`merge.ts`), which reads as what saving
 * writes. Saving itself writes all lines in its own layout.
 */
import { addPoses } from '../../edit/pose/library.ts';
import { readWhole } from '../../formats/reader.ts';
import { partsOf } from '../../model/character-parts.ts';
import { EMPTY_DOCUMENT } from '../../model/document.ts';
import type { FileContent, SourceFile } from '../../model/files.ts';
import { newCharacter } from '../../model/new-character.ts';
import { fileNameOf, isSkeletonKind } from '../../model/part.ts';
import type { LineHunk } from '../../model/text-changes.ts';
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
export async function changedText(source: SourceFile, original: string, owned: readonly Owned[]): Promise<MergedText> {
  const after = savedFileOf(writeParts(source.name, owned)).text;
  const before = await rewritten(source, original, owned);
  if (before === undefined) throw new Error(`${source.name} has errors, so it can’t be compared with what is open.`);
  if (before === after) return { text: original, hunks: [] };
  // Defaults may not suit a joint of another type.
  for (const keepsDefaults of [true, false]) {
    const merged = mergeChanges(original, before, after, keepsDefaults);
    if ((await rewritten(source, merged.text, owned)) === after) return merged;
  }
  return byValue(original, after);
}

/**
 * The text that results from reading a text and saving it again; undefined if it has errors. Equal for texts that say
 * the same.
 *
 * @param owned the parts that are saved in such a file
 */
export async function rewritten(
  source: SourceFile,
  text: string,
  owned: readonly Owned[],
): Promise<string | undefined> {
  const value = await contentOf(source, text, owned);
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

/** Undefined if it has errors. */
async function contentOf(
  { name }: SourceFile,
  text: string,
  owned: readonly Owned[],
): Promise<FileContent | undefined> {
  const format = formatOf(name);
  if (!format?.imports) return readWhole<FileContent>(format?.reader(name) ?? NOTHING, text).value;
  const skeleton = skeletonBeside(owned);
  const bytes = new TextEncoder().encode(text);
  const { value } = await format.imports({
    fileName: name,
    bytes,
    beside: async () => skeleton && { source: skeleton.source, bytes: new TextEncoder().encode(skeleton.text) },
    near: () => (skeleton ? [skeleton.source.name] : []),
  });
  return value;
}

/** The file of the skeleton of a take's character, as it is now; undefined if it has none of its own. */
export function skeletonBeside([first]: readonly Owned[]):
  | { readonly source: SourceFile; readonly text: string }
  | undefined {
  if (!first) return undefined;
  const { character, pose } = first;
  const part = partsOf(character).find(({ kind }) => isSkeletonKind(kind));
  if (!part) return undefined;
  const name = fileNameOf(part);
  const { text } = savedFileOf(writeParts(name, [{ character, part, pose }]));
  return { source: part.file ?? { name, path: name, bytes: text.length }, text };
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
