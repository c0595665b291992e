/**
 * What the page and its worker share: the jobs and their messages. Another kind of work is another entry in `Jobs`;
 * another file format needs no change here (`files/kinds.ts`).
 */
import type { SkinFacts } from '../evaluate/skin/bounds.ts';
import type { ExchangeFormat } from '../export/formats.ts';
import type { GlbOptions } from '../export/glb/options.ts';
import type { ExchangeReport } from '../export/shared/report.ts';
import type { Keep } from '../files/open/layers.ts';
import type { Owned } from '../files/save/owned.ts';
import type { WebPage } from '../files/web-page/web-page.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import type { BrokenFile, ParsedFile, SourceFile } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { Skin } from '../model/skin.ts';
import type { SourceMap } from '../model/source-map.ts';
import type { LineHunk } from '../model/text-changes.ts';
import type { TakeDigest } from '../review/digest.ts';
import type { Comparison } from '../teaching/compare/compare.ts';
import type { Targets } from '../teaching/compare/targets.ts';
import type { NamedDump } from '../teaching/dump/fit-dump.ts';

export interface Jobs {
  parse: { takes: ParseInput; gives: ParseOutput };
  compare: { takes: CompareInput; gives: CompareOutput };
  source: { takes: SourceInput; gives: SourceOutput };
  changes: { takes: ChangesInput; gives: ChangesOutput };
  check: { takes: CheckInput; gives: CheckOutput };
  kit: { takes: undefined; gives: KitOutput };
  exchange: { takes: ExchangeInput; gives: ExchangeOutput };
  webPage: { takes: WebPage; gives: WebPageOutput };
  review: { takes: ReviewInput; gives: ReviewOutput };
  unpack: { takes: UnpackInput; gives: UnpackOutput };
  open: { takes: OpenInput; gives: OpenOutput };
}

export type JobName = keyof Jobs;
/** What the workbench's worker does; the worker of the element in other pages does the rest. */
export type PageJob = Exclude<JobName, 'open'>;

export interface ParseInput {
  readonly files: readonly GivenBlob[];
  /** Given earlier, of those that an output `keeps`: only looked at by files that are read from several. */
  readonly before?: readonly GivenBlob[];
  /** What counts where a plain file was edited since it was saved with its layers; default the edit. */
  readonly keep?: Keep | undefined;
}

/** A file as the browser provides it: its bytes are read in the worker, and never pass through the page. */
export interface GivenBlob {
  /** With folders, separated by `/`. */
  readonly path: string;
  readonly blob: Blob;
}

export interface ParseOutput {
  readonly files: readonly ParsedFile[];
  /** Files with errors. */
  readonly broken: readonly BrokenFile[];
  readonly diagnostics: readonly Diagnostic[];
  /** What the page needs to know of each skin, computed here so that it never loops over a million vertices. */
  readonly facts: readonly KnownSkin[];
  /** Paths of given files that are to be given again, as `before`, with those that come later. */
  readonly keeps: readonly string[];
  /**
   * Of takes with layers: the plain files that were edited since they were saved with them, by name, or by path where
   * names are equal. Absent without any.
   */
  readonly layers?: { readonly edited: readonly string[] };
}

/** Some of the files of an output. */
export interface ParsedPart {
  /** Each with its index among all. */
  readonly files: readonly (readonly [file: ParsedFile, index: number])[];
  /** Skins and morphs are those in `files`, by identity. */
  readonly facts: readonly KnownSkin[];
}

/** Files of characters that are only shown. */
export interface OpenInput {
  readonly files: readonly GivenBlob[];
}

/** The characters, and what drawing them takes. */
export interface OpenOutput {
  readonly characters: readonly Character[];
  /** Of their skins. */
  readonly facts: readonly KnownSkin[];
  readonly diagnostics: readonly Diagnostic[];
  /** The scene's y of the floor, unless it is to be at 0. */
  readonly floor: number;
  /** Of all that plays; absent if there are several, or none. */
  readonly framesPerSecond?: number;
}

/** A zip whose takes are reviewed if there are more than `most`. */
export interface UnpackInput {
  readonly zip: GivenBlob;
  readonly most: number;
}

export interface UnpackOutput {
  /** In the zip's order, below its path; none if there are fewer, or the zip is damaged. */
  readonly takes: readonly GivenBlob[];
}

/** Skin and morphs are those in `files`, by identity. */
export interface KnownSkin {
  readonly skin: Skin;
  readonly morphs: readonly Morph[];
  readonly facts: SkinFacts;
}

/** Numbers of another program, and the character that they are of. */
export interface CompareInput {
  readonly character: Character;
  readonly dumps: readonly NamedDump[];
  /** Names of dumps that may also be of the file pose instead of their assumed time: the numbers decide. */
  readonly undecided?: readonly string[];
  /** Default `DEFAULT_TOLERANCE`. */
  readonly tolerance?: number;
}

export interface CompareOutput {
  /** Absent if the dumps don't fit the character. */
  readonly comparison?: Comparison;
  /** What was compared with it: theirs, each in the place of ours. */
  readonly targets?: Targets;
  /** Names of undecided dumps that are of the file pose. */
  readonly inFilePose: readonly string[];
  readonly diagnostics: readonly Diagnostic[];
}

/** A text file, to be shown as it is. */
export interface SourceInput extends GivenBlob {
  /** Its path in the blob, which is a zip then. */
  readonly inside?: string;
}

export interface SourceOutput {
  readonly map: SourceMap;
  /** The file itself, if it was in a zip. */
  readonly text?: Blob;
}

/** A text file, and the parts of the page that are saved in it. */
export interface ChangesInput {
  /** The file, which may be in a zip. */
  readonly file: SourceInput;
  readonly source: SourceFile;
  readonly owned: readonly Owned[];
}

/** What the page changed in the file. */
export interface ChangesOutput {
  readonly hunks: readonly LineHunk[];
  /** The file with the changes, and what is on its lines; absent if nothing has changed. */
  readonly changed?: { readonly text: Blob; readonly map: SourceMap };
}

/** A text that was edited by hand. */
export interface CheckInput {
  readonly source: SourceFile;
  readonly edited: string;
  /** What it was edited from. */
  readonly base: string;
  readonly owned: readonly Owned[];
}

export interface CheckOutput extends ParseOutput {
  /** It says what the text says that it was edited from. */
  readonly isSame: boolean;
}

/** Takes to be listed, a file each. */
export interface ReviewInput {
  readonly files: readonly GivenBlob[];
  /** Files that these may be read with: skeletons of takes. */
  readonly beside?: readonly GivenBlob[];
}

/** In the order of the files. */
export interface ReviewOutput {
  readonly takes: readonly TakeDigest[];
}

/** A character, to be written for another program where it is in the scene. */
export interface ExchangeInput {
  readonly format: ExchangeFormat;
  readonly character: Character;
  readonly options: GlbOptions;
}

export interface ExchangeOutput {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly report: ExchangeReport;
}

/** A page, and how its file is called. */
export interface WebPageOutput {
  readonly name: string;
  readonly page: Blob;
}

/** The test kit: names and texts of its files. */
export type KitOutput = ReadonlyMap<string, string>;

export type ToWorker<Names extends JobName = JobName> = {
  [K in Names]: { readonly id: number; readonly job: K; readonly input: Jobs[K]['takes'] };
}[Names];

/** The last message of a job. */
export type Done<Names extends JobName = JobName> = {
  [K in Names]: { readonly id: number; readonly kind: 'done'; readonly job: K; readonly output: Jobs[K]['gives'] };
}[Names];

export type FromWorker =
  | { readonly id: number; readonly kind: 'progress'; readonly progress: Progress }
  | { readonly id: number; readonly kind: 'failed'; readonly message: string }
  /** Of the output of `parse`, which has no files itself then. */
  | { readonly id: number; readonly kind: 'part'; readonly part: ParsedPart }
  /** Sent once: the worker holds this Web Lock for as long as it lives. */
  | { readonly kind: 'alive'; readonly lock: string }
  | Done;

export interface Progress {
  /** Name of the file being read, or of what is being done. */
  readonly label: string;
  /** Bytes, or any other unit. */
  readonly done: number;
  readonly of: number;
}
