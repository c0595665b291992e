/**
 * An FBX file as objects with properties, and connections between them. A connection leads from an object to what it is
 * a part of: a curve to its curve node, a joint to its parent, whose id is 0 for the scene itself.
 */
import { TICKS_PER_SECOND } from '../../formats/fbx/constants.ts';
import type { Vec3 } from '../../math/vec3.ts';
import {
  childOf,
  childrenOf,
  type FbxFile,
  type FbxRecord,
  type FbxValue,
  idAt,
  NO_RECORDS,
  numberAt,
  textAt,
} from './records/record.ts';

/** An object of the file, with its properties. */
export interface FbxObject {
  /** Its number among the objects, from 1. */
  readonly id: number;
  /** Name of its record: `Model`, `Geometry`, `Deformer` … */
  readonly kind: string;
  /** Without the class that follows or precedes it. */
  readonly name: string;
  /** Its sub-type: `Mesh`, `LimbNode`, `Cluster` … */
  readonly type: string;
  readonly record: FbxRecord;
  readonly properties: Properties;
}

/** An object at one end of a connection, and the property at its other end that it is connected to. */
export interface Link {
  readonly object: FbxObject;
  readonly property: string | undefined;
}

/** The objects of a file and their connections. */
export interface FbxDocument {
  readonly file: FbxFile;
  readonly settings: Properties;
  readonly objects: readonly FbxObject[];
  readonly isOfBlender: boolean;
  /** Parts that an object consists of, in the order of the file. */
  partsOf(id: number): readonly Link[];
  /** Objects that an object is part of. */
  ownersOf(id: number): readonly Link[];
  /** Units of time in a second. */
  readonly ticks: number;
}

/** The number of the scene's own node, which has no object. */
export const SCENE_ID = 0;

function isScene(id: FbxValue): boolean {
  return id === 0 || id === '0';
}

/** Units of time that newer files may choose. */
const NEW_TICKS = 141120000;
const OLD_TIME_DEFINITION = 127;

/** Values by name: an object's own, and for those it lacks, the ones of the template for objects of its kind. */
export class Properties {
  /** The values of each from the fifth on are its own, after name, type, label and flags. Made when first asked. */
  private byName: Map<string, readonly FbxValue[]> | undefined;
  private list: readonly FbxRecord[] | undefined;

  constructor(
    private readonly record: FbxRecord | undefined,
    private readonly template?: Properties,
  ) {}

  /** One of the values of a property, or else of the template of its kind; undefined if neither has it. */
  private at(name: string, index: number): FbxValue | undefined {
    const values = this.own(name);
    return values ? values[4 + index] : this.template?.at(name, index);
  }

  private own(name: string): readonly FbxValue[] | undefined {
    this.list ??= childOf(this.record, 'Properties70')?.children ?? NO_RECORDS;
    if (this.list.length <= MAX_SEARCHED) {
      // Of several with a name the last counts.
      for (let i = this.list.length - 1; i >= 0; i--) {
        if (this.list[i].values[0] === name && this.list[i].name === 'P') return this.list[i].values;
      }
      return undefined;
    }
    this.byName ??= namedIn(this.list);
    return this.byName.get(name);
  }

  /** A property's first value as a number; undefined if there is none, or it is not finite. */
  number(name: string): number | undefined {
    const value = this.at(name, 0);
    const number = typeof value === 'bigint' ? Number(value) : value;
    return typeof number === 'number' && Number.isFinite(number) ? number : undefined;
  }

  /** A property's first three values; `otherwise` if they are not three finite numbers. */
  vector(name: string, otherwise: Vec3): Vec3 {
    const [x, y, z] = [this.at(name, 0), this.at(name, 1), this.at(name, 2)];
    return isNumber(x) && isNumber(y) && isNumber(z) ? [x, y, z] : otherwise;
  }

  /** A property's first value as text; undefined if it is no text. */
  text(name: string): string | undefined {
    const value = this.at(name, 0);
    return typeof value === 'string' ? value : undefined;
  }
}

function isNumber(value: FbxValue | undefined): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

/** Properties that are looked through for each name: a map takes as long to make as to look through them often. */
const MAX_SEARCHED = 8;

function namedIn(records: readonly FbxRecord[]): Map<string, readonly FbxValue[]> {
  const byName = new Map<string, readonly FbxValue[]>();
  for (const { name, values } of records) {
    const key = values[0];
    if (name === 'P' && typeof key === 'string') byName.set(key, values);
  }
  return byName;
}

/** Sorts the records of a file into objects, and follows its connections. */
export function documentOf(file: FbxFile): FbxDocument {
  const section = (name: string) => file.records.find((record) => record.name === name);
  const templates = templatesOf(section('Definitions'));
  const objects: FbxObject[] = [];
  const byId = new Map<FbxValue, FbxObject>();
  for (const record of section('Objects')?.children ?? []) {
    const id = idAt(record);
    // Of two objects with one id the first counts: connections can't tell them apart.
    if (id === undefined || isScene(id) || byId.has(id)) continue;
    const object = objectOf(record, objects.length + 1, templates);
    objects.push(object);
    byId.set(id, object);
  }
  const parts: (Link[] | undefined)[] = new Array(objects.length + 1);
  const owners: (Link[] | undefined)[] = new Array(objects.length + 1);
  for (const record of childrenOf(section('Connections'), 'C')) {
    const [part, owner] = [idAt(record, 1), idAt(record, 2)];
    const type = textAt(record);
    if (part === undefined || owner === undefined || (type !== 'OO' && type !== 'OP')) continue;
    const property = type === 'OP' ? textAt(record, 3) : undefined;
    const object = byId.get(part);
    const whole = byId.get(owner);
    if (object && (whole || isScene(owner))) list(parts, whole?.id ?? SCENE_ID, { object, property });
    if (object && whole) list(owners, object.id, { object: whole, property });
  }
  const header = section('FBXHeaderExtension');
  const definition = numberAt(childOf(childOf(header, 'OtherFlags'), 'TCDefinition')) ?? OLD_TIME_DEFINITION;
  const isNew = (numberAt(childOf(header, 'FBXHeaderVersion')) ?? 0) >= 1004 && definition !== OLD_TIME_DEFINITION;
  return {
    file,
    settings: new Properties(section('GlobalSettings'), templates('GlobalSettings', 'GlobalSettings')),
    isOfBlender: /^blender\b/i.test(textAt(childOf(header, 'Creator')) ?? ''),
    objects,
    partsOf: (id) => parts[id] ?? NO_LINKS,
    ownersOf: (id) => owners[id] ?? NO_LINKS,
    ticks: isNew ? NEW_TICKS : TICKS_PER_SECOND,
  };
}

const NO_LINKS: readonly Link[] = [];

/** The template for objects of a kind and a type. */
type Templates = (kind: string, type: string) => Properties | undefined;

/** That of the type's own class where a kind has several, such as `FbxCamera`; else the kind's first. */
function templatesOf(definitions: FbxRecord | undefined): Templates {
  const ofKinds = new Map<string, { readonly first: Properties; readonly byClass: Map<string, Properties> }>();
  for (const objectType of childrenOf(definitions, 'ObjectType')) {
    const kind = textAt(objectType) ?? '';
    for (const record of childrenOf(objectType, 'PropertyTemplate')) {
      const template = new Properties(record);
      const own = ofKinds.get(kind) ?? { first: template, byClass: new Map<string, Properties>() };
      ofKinds.set(kind, own);
      own.byClass.set(textAt(record) ?? '', template);
    }
  }
  return (kind, type) => {
    const own = ofKinds.get(kind);
    return own?.byClass.get(`Fbx${type}`) ?? own?.first;
  };
}

/** Binary files say name, 0, 1, class; texts class::name. */
function objectOf(record: FbxRecord, id: number, templates: Templates): FbxObject {
  const kind = record.name;
  const type = textAt(record, 2) ?? '';
  const full = textAt(record, 1) ?? '';
  const zero = full.indexOf('\0');
  const colons = full.indexOf('::');
  const name = zero >= 0 ? full.slice(0, zero) : colons >= 0 ? full.slice(colons + 2) : full;
  return {
    id,
    kind,
    name,
    type,
    record,
    properties: new Properties(record, templates(kind, type)),
  };
}

function list(links: (Link[] | undefined)[], id: number, link: Link): void {
  const known = links[id];
  // A list that begins empty has room for sixteen; most have one.
  if (known) known.push(link);
  else links[id] = [link];
}

/** The parts of an object that are of a kind. */
export function partsOfKind(document: FbxDocument, { id }: FbxObject, kind: string, type?: string): FbxObject[] {
  const found: FbxObject[] = [];
  for (const { object } of document.partsOf(id)) {
    if (object.kind === kind && (type === undefined || object.type === type)) found.push(object);
  }
  return found;
}
