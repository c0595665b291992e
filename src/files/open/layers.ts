/**
 * Joins the files of takes with layers, when files have been read and before they are opened: each `.layers.json` with
 * its base and its layers, found by base name among the files given, becomes one file of a take with the name of the
 * JSON. Its parts are no takes of their own, nor is the plain file beside it, which holds the flattened result.
 *
 *     walk.base.anim  walk.arm.anim  walk.layers.json  walk.anim   →   walk.anim, of a take with layers
 */
import { provideLayers } from '../../evaluate/layers.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import {
  baseName,
  type FileNaming,
  folderOf,
  type ParsedFile,
  type SourceFile,
  sameName,
  stemOf,
} from '../../model/files.ts';
import { ownChannels } from '../../model/skeleton/skel-motion.ts';
import { arranged } from '../../model/takes/layers.ts';
import { type FlattenedFile, LAYERS_EXTENSION, type LayersFile } from '../../model/takes/layers-file.ts';
import { type Layer, restChannel, type Take } from '../../model/takes/take.ts';

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
type AnimParsed = Extract<ParsedFile, { readonly kind: 'anim' }>;
type BaseParsed = AnimParsed | Extract<ParsedFile, { readonly kind: 'bvh' }>;

/** Undefined for files that hold no controls of a take. */
function flattenedIn(file: ParsedFile): FlattenedFile | undefined {
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

/** The plain files among these that were edited since they were saved with controls. */
export function editedPlainFiles(files: readonly ParsedFile[]): readonly ParsedFile[] {
  return plainFilesIn(files).filter((plain) =>
    files.some((file) => {
      const flattened = flattenedIn(file);
      return flattened && fileNamed(files, flattened.file, file.source) === plain && isEdited(plain, flattened);
    }),
  );
}

/** Joins the files of takes with layers; the same lists if there are none. */
export function joinLayers(files: readonly ParsedFile[], keep: Keep, called: FileNaming): Joined {
  const jsons = files.filter((file) => file.kind === 'layers');
  if (jsons.length === 0) return { files, diagnostics: [] };
  provideLayers();
  const diagnostics: Diagnostic[] = [];
  const replaced = new Map<ParsedFile, ParsedFile>();
  const gone = new Set<ParsedFile>();
  for (const json of jsons) {
    const parts = partsOf(json, files, called, diagnostics);
    if (!parts) continue;
    const { base, layers } = parts;
    const { flattened } = json.layers;
    const name = stemOfTake(json.source);
    const plain = plainOf(json, files, base);
    for (const part of [base, ...layers, json]) gone.add(part);
    const isOther = plain !== undefined && flattened !== undefined && isEdited(plain, flattened);
    if (isOther) diagnostics.push(edited(plain, keep, called(json.source)));
    if (isOther && keep === 'edit') continue;
    const take = layeredTake(json.layers, base, layers, name, called(json.source), diagnostics);
    // Other bytes than those of the plain file are written anew, so it doesn't count as read.
    const source: SourceFile = plain && !isOther ? plain.source : plainSource(plain, json.source, name);
    const beside = [json, base, ...layers].map((part) => part.source);
    if (base.kind === 'bvh') {
      const captures = base.captures.map((capture, i) => (i === 0 ? { ...capture, take } : capture));
      replaced.set(base, { ...base, captures, beside: beside.filter((one) => one !== base.source) });
      gone.delete(base);
      continue;
    }
    const joined: ParsedFile = { kind: 'anim', take, source, beside, ...(isOther && { isJoinedByChoice: true }) };
    if (plain) gone.add(plain);
    replaced.set(json, joined);
    gone.delete(json);
  }
  const all = files.flatMap((file) => replaced.get(file) ?? (gone.has(file) ? [] : [file]));
  return { files: all, diagnostics };
}

function isEdited({ sha256 }: ParsedFile, flattened: FlattenedFile): boolean {
  return sha256 !== undefined && sha256 !== flattened.sha256;
}

/** `walk.layers.json` → `walk`. */
function stemOfTake({ name }: SourceFile): string {
  return name.toLowerCase().endsWith(`.${LAYERS_EXTENSION}`)
    ? name.slice(0, -LAYERS_EXTENSION.length - 1)
    : stemOf({ name, path: name, bytes: 0 });
}

function plainSource(plain: ParsedFile | undefined, json: SourceFile, name: string): SourceFile {
  if (plain) return { ...plain.source };
  const folder = folderOf(json);
  return { name: `${name}.anim`, path: folder ? `${folder}/${name}.anim` : `${name}.anim`, bytes: 0 };
}

/** The plain file beside a JSON: the one that it names, else the one with its name. */
function plainOf(json: LayersParsed, files: readonly ParsedFile[], base: BaseParsed): AnimParsed | undefined {
  const name = json.layers.flattened?.file ?? `${stemOfTake(json.source)}.anim`;
  const found = fileNamed(files, name, json.source);
  return found?.kind === 'anim' && found !== base ? found : undefined;
}

/** By base name, the folder of the file that names it first. */
function fileNamed(files: readonly ParsedFile[], name: string, by: SourceFile): ParsedFile | undefined {
  const fits = files.filter(({ source }) => sameName(source.name, baseName(name)));
  return fits.find(({ source }) => folderOf(source) === folderOf(by)) ?? fits[0];
}

/** The files that a JSON names; undefined, with an error, if one is missing. */
function partsOf(
  { layers, source }: LayersParsed,
  files: readonly ParsedFile[],
  called: FileNaming,
  diagnostics: Diagnostic[],
): { readonly base: BaseParsed; readonly layers: readonly AnimParsed[] } | undefined {
  const missing = (path: string, name: string) => {
    const message = `${path}: the file "${name}" was not among the files, or has errors.`;
    const problem = withoutPlace('error', 'layer-file-missing', message, called(source));
    diagnostics.push({ ...problem, missing: baseName(name) });
  };
  const base = fileNamed(files, layers.base, source);
  const isBase = base?.kind === 'anim' || (base?.kind === 'bvh' && base.captures[0]?.take !== undefined);
  if (!isBase) missing('base', layers.base);
  const found = layers.layers.map((row, i) => {
    const file = fileNamed(files, row.file, source);
    if (file?.kind === 'anim') return file;
    missing(`layers[${i}].file`, row.file);
    return undefined;
  });
  const own = found.filter((file) => file !== undefined);
  return isBase && own.length === found.length ? { base, layers: own } : undefined;
}

function edited(plain: ParsedFile, keep: Keep, json: string): Diagnostic {
  const message = `flattened.sha256: ${plain.source.name} has been edited since it was saved with these layers.`;
  const assumed = keep === 'edit' ? `used ${plain.source.name}, without its layers` : 'used the layers';
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
