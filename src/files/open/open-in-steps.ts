/**
 * Opening files: turns files that were read into new characters or parts of existing ones. Used by both page and
 * command, so `marrow info` reports what dropping the same files would.
 *
 * A file that has errors or does not fit holds back only what depends on it: a skeleton its skins, morphs and takes, a
 * skin its morphs. These wait for it; the rest of the character is opened without them. A skeleton that does not fit
 * what its character had before leaves that as it was.
 */

import { cutName } from '../../edit/cut-name.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Document, UnusedFile } from '../../model/document.ts';
import { type BrokenFile, byFileName, type ParsedFile } from '../../model/files.ts';
import { adoptTakes } from './adopted-takes.ts';
import { groupFiles, isRead, type LooseRole, namesFile } from './grouping.ts';
import { openGroup } from './groups.ts';
import { dressAll, openParts, openPoses, takeUpWaiting } from './loose-files.ts';
import { isSameFile } from './matching.ts';
import { nameApart } from './names-apart.ts';
import { type OpenBeside, Opening } from './opening.ts';

/** A file with numbers of another program. */
export type DumpFile = Extract<ParsedFile, { readonly kind: 'dump' }>;

/** The document after opening files, and what there is to say about it. */
export interface OpenResult {
  /** The same object if nothing was opened. */
  readonly document: Document;
  readonly diagnostics: readonly Diagnostic[];
  /** Ids of new or changed characters. */
  readonly opened: readonly string[];
  /** Numbers to compare with a character, which the caller chooses; the document has none of them. */
  readonly dumps: readonly DumpFile[];
  /** Label of the undo entry: "Open wasp.skel and 2 more". */
  readonly label: string;
}

/**
 * Opens files that were read, in steps, one for each file of a character: there may be thousands. Other parameters are
 * those of `openFiles`.
 *
 * @param beside `openBeside`; not needed if none of the files, nor of those that wait, is JSON beside another one
 */
export function* openInSteps(
  document: Document,
  files: readonly ParsedFile[],
  broken: readonly BrokenFile[] = [],
  selectedId?: string,
  called = byFileName,
  beside?: OpenBeside,
): Steps<OpenResult> {
  const opening = new Opening(document, files, broken, selectedId, called, beside);
  const wanted = opening.waiting.filter((waiting) => isCalledFor(files, waiting)).map(({ file }) => file);
  const grouping = groupFiles([...files, ...broken.map((b) => ({ ...b, broken: true as const })), ...wanted], called);
  opening.diagnostics.push(...grouping.diagnostics);
  for (const group of grouping.groups) yield* openGroup(opening, group);
  adoptTakes(opening);
  const dumps: DumpFile[] = [];
  const openLoose: { readonly [R in LooseRole]: (loose: readonly ParsedFile[]) => void } = {
    part: (loose) => {
      openParts(opening, loose);
      // What is beside takes is found by their names.
      nameApart(opening);
    },
    // After all characters, each of which they can apply to.
    beside: (loose) => {
      for (const file of loose) beside?.(opening, file);
    },
    poses: (loose) => {
      for (const file of loose) if (file.kind === 'pose') openPoses(opening, file);
    },
    // Without the files that they name; the error says which.
    layers: () => undefined,
    // Given to skins at the end, together with those that were waiting.
    texture: () => undefined,
    dump: (loose) => {
      for (const file of loose) if (file.kind === 'dump') dumps.push(file);
    },
  };
  // In this order. Its keys are the roles, which TypeScript types as strings.
  for (const role of Object.keys(openLoose) as LooseRole[]) openLoose[role](grouping.loose[role].filter(isRead));
  for (const rig of grouping.idleRigs.filter(isRead)) {
    opening.unused.push({ file: rig, why: 'None of the files it names was opened.' });
  }
  takeUpWaiting(opening);
  dressAll(opening);
  return { ...resultOf(opening), dumps };
}

function resultOf(opening: Opening): Omit<OpenResult, 'dumps'> {
  const { document, base, files, opened, used, characters, charactersMade, called } = opening;
  const unused = sameFiles(opening.unused, document.unused) ? document.unused : opening.unused;
  const given = new Set(files);
  for (const { file, why, waitsFor } of unused) {
    if (!given.has(file)) continue;
    const [code, message, assumed] = waitsFor
      ? ['held-back', `Not opened. ${why}`, 'kept until that is corrected']
      : ['file-unused', `Not used: ${why}`, 'kept for a matching file'];
    opening.diagnostics.push(withoutPlace('info', code, message, called(file.source), assumed));
  }
  const changed = files.filter((f) => used.has(f) || f.kind === 'texture');
  const rest = {
    diagnostics: opening.diagnostics,
    opened: [...opened],
    label: openLabel(changed.length ? changed : files),
  };
  if (opened.size === 0) {
    // If nothing was opened, the opening example stays.
    return { ...rest, document: unused === document.unused ? document : { ...document, unused } };
  }
  const next = { characters: characters.all, unused, charactersMade, isOpeningSample: false };
  return { ...rest, document: { ...base, ...next } };
}

/** Whether one of the files names a waiting one, is named by it, or is the one that it waits for. */
function isCalledFor(files: readonly ParsedFile[], { file, waitsFor }: UnusedFile): boolean {
  return files.some(
    (f) =>
      namesFile(f, file.source) ||
      namesFile(file, f.source) ||
      (waitsFor !== undefined && isSameFile(waitsFor, f.source)),
  );
}

function sameFiles(a: readonly UnusedFile[], b: readonly UnusedFile[]): boolean {
  return a.length === b.length && a.every((u, i) => u.file === b[i].file);
}

/** Characters of a file's name in the undo step. */
const FILE_LENGTH = 40;

function openLabel(files: readonly ParsedFile[]): string {
  const first = cutName(files[0]?.source.name ?? 'files', FILE_LENGTH);
  return files.length > 1 ? `Open ${first} and ${files.length - 1} more` : `Open ${first}`;
}
