/** The objects of an FBX file with their connections, and what is around them. */
import { CUSTOM_RATE, RATES, TICKS_PER_SECOND } from '../../formats/fbx/constants.ts';
import type { Space } from '../../model/space.ts';
import {
  CREATION_TIME,
  double,
  type FbxBytes,
  type FbxOut,
  FILE_ID,
  fileOf,
  int,
  long,
  named,
  raw,
  record,
  text,
  VERSION,
} from './records.ts';

/** A property of an object: its name, type, label and flags, and its values. */
export function property(
  name: string,
  [type, label, flags]: readonly [type: string, label: string, flags: string],
  ...values: readonly FbxBytes[]
): FbxOut {
  return record('P', [text(name), text(type), text(label), text(flags), ...values]);
}

/** An integer as a property. */
export function intProperty(name: string, value: number): FbxOut {
  return property(name, ['int', 'Integer', ''], int(value));
}

/** A number as a property. */
export function numberProperty(name: string, value: number): FbxOut {
  return property(name, ['double', 'Number', ''], double(value));
}

/** A time in ticks as a property. */
export function timeProperty(name: string, ticks: number): FbxOut {
  return property(name, ['KTime', 'Time', ''], long(ticks));
}

/** The record of properties. */
export function properties(...list: readonly FbxOut[]): FbxOut {
  return record('Properties70', [], list);
}

/** The root of the scene. */
export const SCENE = 0;
const FIRST_ID = 1_000_000;

/** How lengths and axes are meant. */
export interface FbxSpace {
  readonly up: Space['up'];
  /** Centimetres per unit. */
  readonly centimetres: number;
}

/** A take as the file lists it, in ticks. */
export interface ListedTake {
  readonly name: string;
  readonly start: number;
  readonly end: number;
}

/** Collects objects and how they are connected. */
export class FbxDocument {
  private readonly objects: FbxOut[] = [];
  private readonly connections: FbxOut[] = [];
  private next = FIRST_ID;

  /** Adds an object; returns its id. */
  add(kind: string, name: FbxBytes, type: string, children: readonly FbxOut[]): number {
    const id = this.next++;
    this.objects.push(record(kind, [long(id), name, text(type)], children));
    return id;
  }

  /** Makes one object part of another, or of one of its properties. */
  connect(part: number, whole: number, property?: string): void {
    const kind = property === undefined ? 'OO' : 'OP';
    this.connections.push(
      record('C', [text(kind), long(part), long(whole), ...(property === undefined ? [] : [text(property)])]),
    );
  }

  /** The file, in pieces. */
  file(space: FbxSpace, takes: readonly ListedTake[], framesPerSecond: number | undefined): readonly FbxBytes[] {
    const current = takes[0]?.name ?? '';
    return fileOf([
      header(),
      record('FileId', [raw(FILE_ID)]),
      record('CreationTime', [text(CREATION_TIME)]),
      record('Creator', [text(CREATOR)]),
      settings(space, takes, framesPerSecond),
      record(
        'Documents',
        [],
        [
          record('Count', [int(1)]),
          record(
            'Document',
            [long(this.next), text(''), text('Scene')],
            [
              properties(
                property('SourceObject', ['object', '', '']),
                property('ActiveAnimStackName', ['KString', '', ''], text(current)),
              ),
              record('RootNode', [long(SCENE)]),
            ],
          ),
        ],
      ),
      record('References'),
      this.definitions(),
      record('Objects', [], this.objects),
      record('Connections', [], this.connections),
      record(
        'Takes',
        [],
        [
          record('Current', [text(current)]),
          ...takes.map(({ name, start, end }) =>
            record(
              'Take',
              [text(name)],
              [
                record('FileName', [text(`${name}.tak`)]),
                record('LocalTime', [long(start), long(end)]),
                record('ReferenceTime', [long(start), long(end)]),
              ],
            ),
          ),
        ],
      ),
    ]);
  }

  private definitions(): FbxOut {
    const counts = new Map<string, number>([['GlobalSettings', 1]]);
    for (const { name } of this.objects) counts.set(name, (counts.get(name) ?? 0) + 1);
    return record(
      'Definitions',
      [],
      [
        record('Version', [int(100)]),
        record('Count', [int(this.objects.length + 1)]),
        ...[...counts].map(([kind, count]) => record('ObjectType', [text(kind)], [record('Count', [int(count)])])),
      ],
    );
  }
}

const CREATOR = 'Marrow';

function header(): FbxOut {
  const time = [1970, 1, 1, 10, 0, 0, 0];
  const parts = ['Year', 'Month', 'Day', 'Hour', 'Minute', 'Second', 'Millisecond'];
  return record(
    'FBXHeaderExtension',
    [],
    [
      record('FBXHeaderVersion', [int(1003)]),
      record('FBXVersion', [int(VERSION)]),
      record('EncryptionType', [int(0)]),
      record(
        'CreationTimeStamp',
        [],
        [record('Version', [int(1000)]), ...parts.map((part, i) => record(part, [int(time[i])]))],
      ),
      record('Creator', [text(CREATOR)]),
      record(
        'SceneInfo',
        [named('GlobalInfo', 'SceneInfo'), text('UserData')],
        [
          record('Type', [text('UserData')]),
          record('Version', [int(100)]),
          record(
            'MetaData',
            [],
            [
              record('Version', [int(100)]),
              ...['Title', 'Subject', 'Author', 'Keywords', 'Revision', 'Comment'].map((name) =>
                record(name, [text('')]),
              ),
            ],
          ),
          properties(
            property('Original|ApplicationName', ['KString', '', ''], text(CREATOR)),
            property('LastSaved|ApplicationName', ['KString', '', ''], text(CREATOR)),
          ),
        ],
      ),
    ],
  );
}

/** Relative difference of rates that is none: files round them. */
const SAME_RATE = 1e-5;
/** Drop-frame ways of counting, which no take asks for. */
const DROP_FRAME = new Set([7, 8]);

function settings(
  { up, centimetres }: FbxSpace,
  takes: readonly ListedTake[],
  framesPerSecond: number | undefined,
): FbxOut {
  const isUp = up !== 'z';
  const sign = up === 'y' ? 1 : -1;
  const mode =
    framesPerSecond === undefined
      ? 0
      : RATES.findIndex(
          (rate, i) => rate !== undefined && !DROP_FRAME.has(i) && Math.abs(rate / framesPerSecond - 1) < SAME_RATE,
        );
  const end = takes.length ? Math.max(...takes.map((take) => take.end)) : TICKS_PER_SECOND;
  const start = takes.length ? Math.min(...takes.map((take) => take.start)) : 0;
  return record(
    'GlobalSettings',
    [],
    [
      record('Version', [int(1000)]),
      properties(
        intProperty('UpAxis', isUp ? 1 : 2),
        intProperty('UpAxisSign', up === '-y' ? -1 : 1),
        intProperty('FrontAxis', isUp ? 2 : 1),
        intProperty('FrontAxisSign', sign),
        intProperty('CoordAxis', 0),
        intProperty('CoordAxisSign', 1),
        intProperty('OriginalUpAxis', isUp ? 1 : 2),
        intProperty('OriginalUpAxisSign', up === '-y' ? -1 : 1),
        numberProperty('UnitScaleFactor', centimetres),
        numberProperty('OriginalUnitScaleFactor', centimetres),
        property('DefaultCamera', ['KString', '', ''], text('Producer Perspective')),
        property('TimeMode', ['enum', '', ''], int(mode < 0 ? CUSTOM_RATE : mode)),
        timeProperty('TimeSpanStart', start),
        timeProperty('TimeSpanStop', end),
        numberProperty('CustomFrameRate', mode < 0 && framesPerSecond !== undefined ? framesPerSecond : -1),
      ),
    ],
  );
}
