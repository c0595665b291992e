/**
 * `marrow/export`: a character as files for other programs.
 *
 *     const { bytes } = writeGlb(character);
 */

import { provideLayers } from '../evaluate/layers.ts';
import { writeFbx as fbxOf } from '../export/fbx/write.ts';
import { DEFAULT_GLB, type GlbOptions } from '../export/glb/options.ts';
import { writeGlb as glbOf } from '../export/glb/write.ts';
import type { ExchangeOptions } from '../export/shared/options.ts';
import { diagnosticsOf, type ExchangeFile, type ExchangeReport } from '../export/shared/report.ts';
import { outputsOf, type Target } from '../files/save/conversion.ts';
import type { Output } from '../files/save/output.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { joined } from './joined.ts';

export type { GlbOptions } from '../export/glb/options.ts';
export type { ExchangeOptions } from '../export/shared/options.ts';
export type { ExchangeReport, Loss, TakeReport } from '../export/shared/report.ts';
export type { Target as ConvertFormat } from '../files/save/conversion.ts';
export type { Diagnostic } from '../model/diagnostic.ts';
export type { Character } from '../model/document.ts';

provideLayers();

/** Options of `writeGlb`. */
export interface GlbSettings extends Partial<GlbOptions> {
  /** Keeps the file's own unit, axes and origin instead of metres and y up. */
  readonly raw?: boolean;
}

/** A file for other programs. */
export interface WrittenExchange {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** What is in it, and what it can't have as the character has it. */
  readonly report: ExchangeReport;
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Writes a character with its takes as GLB: glTF 2.0 in one binary file.
 * @throws UserError if a take can't be written, or `take` names none
 */
export function writeGlb(character: Character, settings: GlbSettings = {}): WrittenExchange {
  const { raw = false, ...options } = settings;
  return written(glbOf(character, { ...DEFAULT_GLB, ...options }, !raw), `${character.name}.glb`);
}

/** Options of `writeFbx`: a character without a skin needs no body. */
export type FbxSettings = Omit<ExchangeOptions, 'body'>;

/**
 * Writes a character with its takes as binary FBX, in its own unit and axes, which the file states.
 * @throws UserError if a take can't be written, or `take` names none
 */
export function writeFbx(character: Character, settings: FbxSettings = {}): WrittenExchange {
  return written(fbxOf(character, { ...settings, body: false }), `${character.name}.fbx`);
}

function written({ pieces, report }: ExchangeFile, name: string): WrittenExchange {
  return { bytes: joined(pieces), report, diagnostics: diagnosticsOf(report, name) };
}

/** A file that a character was converted to. */
export interface ConvertedFile {
  /** Of the part that it holds, with the extension. */
  readonly name: string;
  readonly text: string;
  readonly diagnostics: readonly Diagnostic[];
}

/** Options of `convertCharacter`. */
export interface ConvertSettings {
  /** Of `bvh` and `asf`; absent: each take's own, or 30. */
  readonly framesPerSecond?: number;
}

/**
 * Converts a character to text files of another format, a file for each take.
 *
 * @param format `skel` gives the skeleton and takes as `.anim`, `anim` the takes alone, `bvh` a file for each take,
 * `asf` a skeleton and `.amc` files, `rig` all parts
 * @throws UserError for more frames than can be sampled
 */
export function convertCharacter(
  character: Character,
  format: Target,
  settings: ConvertSettings = {},
): readonly ConvertedFile[] {
  return outputsOf([character], format, settings).map(textOf);
}

function textOf({ name, pieces, diagnostics }: Output): ConvertedFile {
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of pieces()) text += typeof piece === 'string' ? piece : decoder.decode(piece, { stream: true });
  return { name, text: text + decoder.decode(), diagnostics: diagnostics() };
}
