/**
 * Joins the files of takes with layers, goals of limbs or attachments, when files have been read and before they are
 * opened: each `.layers.json`, `.limbs.json` and `.attach.json` with its base and its layers, found by base name among
 * the files given, becomes one file of a take with the name of the JSON. Its parts are no takes of their own, nor is
 * the plain file beside it, which holds the flattened result.
 *
 *     walk.base.anim  walk.arm.anim  walk.layers.json  walk.anim   →   walk.anim, of a take with layers
 *     walk.base.anim  walk.limbs.json  walk.anim                   →   walk.anim, of the base, and walk.limbs.json
 *
 * Goals and attachments are given to the take once it is open (`beside-files.ts`, `attach.ts`), since they depend on
 * the limbs of its character, and on other characters.
 */
import { provideLayers } from '../../evaluate/layers.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { baseName, type FileNaming, folderOf, type ParsedFile, type SourceFile, sameName } from '../../model/files.ts';
import { ownChannels } from '../../model/skeleton/skel-motion.ts';
import { arranged } from '../../model/takes/layers.ts';
import type { FlattenedFile, LayersFile } from '../../model/takes/layers-file.ts';
import { type Layer, restChannel, type Take } from '../../model/takes/take.ts';
import { nameBeside } from '../kinds.ts';

/** The two ways to take a plain file with other bytes than those that were saved with its controls. */
export const KEEP = ['edit', 'controls'] as const;
/** See `KEEP`. */
export type Keep = (typeof KEEP)[number];

/** Files with those of takes with layers joined. */
export interface Joined {
  readonly files: readonly ParsedFile[];
  readonly diagnostics: readonly Diagnostic[];
}

type LayersParsed = Extract<ParsedFile, { readonly kind: 'layers' }>;
type LimbsParsed = Extract<ParsedFile, { readonly kind: 'limbs' }>;
type AttachParsed = Extract<ParsedFile, { readonly kind: 'attach' }>;
type AnimParsed = Extract<ParsedFile, { readonly kind: 'anim' }>;
type BaseParsed = AnimParsed | Extract<ParsedFile, { readonly kind: 'bvh' }>;

/** Undefined for files that hold no controls of a take. */
function flattenedIn(file: ParsedFile): FlattenedFile | undefined {
  if (file.kind === 'limbs') return file.limbs.goals && file.limbs.flattened;
  if (file.kind === 'attach') return file.attach.flattened;
  return file.kind === 'layers' ? file.layers.flattened : undefined;
}

/** The plain files whose hash has to be known: `ParsedFile.sha256`. */
export function plainFilesIn(files: readonly ParsedFile[]): readonly ParsedFile[] {
  return files.flatMap((file) => {
    const { file: name } = flattenedIn(file) ?? {};
    const plain = name === undefined ? undefined : fileNamed(files, name, file.source);
    return plain ? [plain] : [];
  });
}

/** The plain files among these that were edited since they were saved with controls, each once. */
export function editedPlainFiles(files: readonly ParsedFile[]): readonly ParsedFile[] {
  return [...new Set(plainFilesIn(files))].filter((plain) =>
    files.some((file) => {
      const flattened = flattenedIn(file);
      return flattened && fileNamed(files, flattened.file, file.source) === plain && isEdited(plain, flattened);
    }),
  );
}

/** The JSON files of one take. */
interface Controls {
  readonly layers?: LayersParsed;
  readonly limbs?: LimbsParsed;
  readonly attach?: AttachParsed;
  /** The first of them. */
  readonly json: LayersParsed | LimbsParsed | AttachParsed;
  readonly name: string;
}

/** The controls of each take, in the order of the files. */
function controlsIn(files: readonly ParsedFile[]): readonly Controls[] {
  const all = new Map<string, Controls>();
  for (const file of files) {
    if (file.kind !== 'layers' && file.kind !== 'attach' && !(file.kind === 'limbs' && file.limbs.goals)) continue;
    const name = nameBeside(file.source.name);
    const key = `${folderOf(file.source)}/${name}`.toLowerCase();
    const known = all.get(key) ?? { json: file, name };
    const own = file.kind === 'layers' ? { layers: file } : file.kind === 'attach' ? { attach: file } : { limbs: file };
    all.set(key, { ...known, ...own });
  }
  return [...all.values()];
}

/** Joins the files of takes with layers or goals; the same lists if there are none. */
export function joinLayers(files: readonly ParsedFile[], keep: Keep, called: FileNaming): Joined {
  const all = controlsIn(files);
  if (all.length === 0) return { files, diagnostics: [] };
  provideLayers();
  const diagnostics: Diagnostic[] = [];
  const replaced = new Map<ParsedFile, ParsedFile>();
  const gone = new Set<ParsedFile>();
  const drop = ({ layers, limbs, attach }: Controls) => {
    for (const json of [layers, attach]) if (json) gone.add(json);
    const left = limbs && limbsAlone(limbs);
    if (left) replaced.set(limbs, left);
    else if (limbs) gone.add(limbs);
  };
  for (const controls of all) {
    const { json, name } = controls;
    const parts = partsOf(controls, files, called, diagnostics);
    if (!parts) {
      drop(controls);
      continue;
    }
    const { base, layers } = parts;
    const plain = plainOf(controls, files, base);
    const other = [controls.layers, controls.limbs, controls.attach].find(
      (one) => one && plain && isEditedBeside(plain, one),
    );
    const isOther = plain !== undefined && other !== undefined;
    if (isOther) diagnostics.push(edited(plain, keep, called(other.source)));
    if (isOther && keep === 'edit') {
      for (const part of [base, ...layers]) gone.add(part);
      drop(controls);
      continue;
    }
    const take = takeOfParts(controls, parts, called, diagnostics);
    if (controls.layers) gone.add(controls.layers);
    for (const part of layers) gone.add(part);
    // Other bytes than those of the plain file are written anew, so it doesn't count as read.
    const source: SourceFile = plain && !isOther ? plain.source : plainSource(plain, json.source, name);
    const beside = [...(controls.layers ? [controls.layers] : []), base, ...layers].map((part) => part.source);
    if (base.kind === 'bvh') {
      const captures = base.captures.map((capture, i) => (i === 0 ? { ...capture, take } : capture));
      const others = beside.filter((one) => one !== base.source);
      if (controls.layers) replaced.set(base, { ...base, captures, beside: others });
      continue;
    }
    if (plain) gone.add(plain);
    const { attach } = controls;
    // Without what it follows the plain file holds; one that was edited is no longer that.
    if (attach && plain && !isOther) replaced.set(attach, { ...attach, plain: { ...plain.take, name } });
    replaced.set(base, { kind: 'anim', take, source, beside, ...(isOther && { isJoinedByChoice: true }) });
  }
  const joined = files.flatMap((file) => replaced.get(file) ?? (gone.has(file) ? [] : [file]));
  return { files: joined, diagnostics };
}

/** A file of limbs and goals without its goals; undefined where it holds no limbs. */
export function limbsAlone(file: LimbsParsed): LimbsParsed | undefined {
  const { goals: _goals, base: _base, flattened: _flattened, ...rest } = file.limbs;
  return rest.limbs && { ...file, limbs: rest };
}

function isEditedBeside(plain: ParsedFile, json: ParsedFile): boolean {
  const flattened = flattenedIn(json);
  return flattened !== undefined && isEdited(plain, flattened);
}

function isEdited({ sha256 }: ParsedFile, flattened: FlattenedFile): boolean {
  return sha256 !== undefined && sha256 !== flattened.sha256;
}

function plainSource(plain: ParsedFile | undefined, json: SourceFile, name: string): SourceFile {
  if (plain) return { ...plain.source };
  const folder = folderOf(json);
  return { name: `${name}.anim`, path: folder ? `${folder}/${name}.anim` : `${name}.anim`, bytes: 0 };
}

/** The plain file beside JSON: the one that it names, else the one with its name. */
function plainOf(
  { layers, limbs, attach, name, json }: Controls,
  files: readonly ParsedFile[],
  base: BaseParsed,
): AnimParsed | undefined {
  const named = layers?.layers.flattened ?? limbs?.limbs.flattened ?? attach?.attach.flattened;
  const found = fileNamed(files, named?.file ?? `${name}.anim`, json.source);
  return found?.kind === 'anim' && found !== base ? found : undefined;
}

/** By base name, the folder of the file that names it first. */
function fileNamed(files: readonly ParsedFile[], name: string, by: SourceFile): ParsedFile | undefined {
  const fits = files.filter(({ source }) => sameName(source.name, baseName(name)));
  return fits.find(({ source }) => folderOf(source) === folderOf(by)) ?? fits[0];
}

interface Parts {
  readonly base: BaseParsed;
  readonly layers: readonly AnimParsed[];
}

/** The files that the JSON of a take names; undefined, with an error, if one is missing. */
function partsOf(
  { layers, limbs, attach, json: { source } }: Controls,
  files: readonly ParsedFile[],
  called: FileNaming,
  diagnostics: Diagnostic[],
): Parts | undefined {
  const missing = (path: string, name: string) => {
    const message = `${path}: the file "${name}" was not among the files, or has errors.`;
    const problem = withoutPlace('error', 'layer-file-missing', message, called(source));
    diagnostics.push({ ...problem, missing: baseName(name) });
  };
  const { base: named = '' } = layers?.layers ?? limbs?.limbs ?? attach?.attach ?? {};
  const base = fileNamed(files, named, source);
  const isBase = base?.kind === 'anim' || (base?.kind === 'bvh' && base.captures[0]?.take !== undefined);
  if (!isBase) missing('base', named);
  const rows = layers?.layers.layers ?? [];
  const found = rows.map((row, i) => {
    const file = fileNamed(files, row.file, source);
    if (file?.kind === 'anim') return file;
    missing(`layers[${i}].file`, row.file);
    return undefined;
  });
  const own = found.filter((file) => file !== undefined);
  return isBase && own.length === found.length ? { base, layers: own } : undefined;
}

/** The take of the base, with its layers. */
function takeOfParts(
  { layers: json, name }: Controls,
  { base, layers }: Parts,
  called: FileNaming,
  diagnostics: Diagnostic[],
): Take {
  if (json) return layeredTake(json.layers, base, layers, name, called(json.source), diagnostics);
  const take = base.kind === 'anim' ? base.take : base.captures[0].take;
  // `partsOf` has found it.
  if (!take) throw new Error(`${base.source.name} has no take.`);
  return { ...take, name };
}

function edited(plain: ParsedFile, keep: Keep, json: string): Diagnostic {
  const message = `flattened.sha256: ${plain.source.name} has been edited since it was saved with its controls.`;
  const assumed = keep === 'edit' ? `used ${plain.source.name}, without its controls` : 'used the controls';
  return withoutPlace('warning', 'flattened-edited', message, json, assumed);
}

/** The take with its layers; the base is active. */
function layeredTake(
  file: LayersFile,
  base: BaseParsed,
  parts: readonly AnimParsed[],
  name: string,
  json: string,
  diagnostics: Diagnostic[],
): Take {
  const [capture] = base.kind === 'bvh' ? base.captures : [];
  const beneath = base.kind === 'anim' ? base.take : capture?.take;
  // `partsOf` has found it.
  if (!beneath) throw new Error(`${base.source.name} has no take.`);
  const skeleton = capture?.skeleton;
  const count = beneath.channels.length;
  const list = file.layers.map((row, i): Layer => {
    // Motion capture has its DOFs in an order of its own.
    const { take } = parts[i];
    const { channels } = skeleton ? ownChannels(take, skeleton, []) : take;
    if (channels.length !== count) {
      const message = `layers[${i}].file: expected ${count} channels in ${parts[i].source.name}, as in the base, found ${channels.length}.`;
      diagnostics.push(withoutPlace('warning', 'layer-channels', message, json, 'used what matches'));
    }
    const fitted = Array.from({ length: count }, (_, c) => channels[c] ?? restChannel());
    return { ...row, motion: { channels: fitted } };
  });
  const { layers: _layers, base: baseFile, flattened, others } = file;
  const named = { ...beneath, ...(base.kind === 'anim' && { name }) };
  const take = arranged(named, beneath, list, -1);
  const facts = { baseFile, ...(flattened?.others && { ofFlattened: flattened.others }), ...(others && { others }) };
  return { ...take, layers: { active: -1, list: [], ...take.layers, ...facts } };
}
