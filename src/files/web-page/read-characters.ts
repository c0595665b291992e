/**
 * Reads the files of a saved page. They are plain ones, in the order of what they hold, a folder per character, and the
 * page says how each is shown: nothing here has to be found out, matched or guessed.
 */
import { pointCapture } from '../../evaluate/point-capture.ts';
import { readAmc } from '../../formats/acclaim/read-amc.ts';
import { asfReader } from '../../formats/acclaim/read-asf.ts';
import { animReader } from '../../formats/anim/read.ts';
import { bvhReader } from '../../formats/bvh/read.ts';
import { stemOfName } from '../../formats/grammar.ts';
import { morphReader } from '../../formats/morph/read.ts';
import { type Reader, readWhole } from '../../formats/reader.ts';
import { Report } from '../../formats/report.ts';
import { skelReader } from '../../formats/skel/read.ts';
import { skinReader } from '../../formats/skin/read.ts';
import { textureReader } from '../../formats/texture/read.ts';
import { Budget } from '../../import/budget.ts';
import { Remarks } from '../../import/imported.ts';
import { readTrc } from '../../import/points/trc.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { baseName, type Capture } from '../../model/files.ts';
import { newCharacter } from '../../model/new-character.ts';
import { withPositions } from '../../model/skeleton/position-channels.ts';
import { ownChannels } from '../../model/skeleton/skel-motion.ts';
import type { Shown } from './shown-characters.ts';

/** A file of a page. */
export interface SavedFile {
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** The characters of a page, and what is wrong with its files. */
export interface ReadCharacters {
  /** In the order of `shown`. */
  readonly characters: readonly Character[];
  readonly diagnostics: readonly Diagnostic[];
}

/** The characters of a saved page. */
export function readCharacters(files: readonly SavedFile[], shown: readonly Shown[]): ReadCharacters {
  const diagnostics: Diagnostic[] = [];
  const characters = shown.map((one, i) => {
    let character = newCharacter(`c${i}`, one.name);
    for (const { path, bytes } of files.filter((file) => file.path.startsWith(`${one.folder}/`))) {
      const read = READERS[path.slice(path.lastIndexOf('.') + 1)] ?? texture;
      character = read({ character, name: baseName(path), bytes, shown: one, diagnostics });
    }
    return asShown(character, one);
  });
  return { characters, diagnostics };
}

function asShown(read: Character, { folder: _, positions: __, ...kept }: Shown): Character {
  return { ...read, ...kept };
}

/** A file, and the character of those before it. */
interface Reading {
  readonly character: Character;
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly shown: Shown;
  readonly diagnostics: Diagnostic[];
}

type Read = (reading: Reading) => Character;

const skel = readBy(skelReader, (character, [skeleton]) => ({ ...character, skeleton }));
const texture = readBy(textureReader, (character, read) => ({ ...character, textures: [...character.textures, read] }));

/** By extension; those of pictures are none of these. */
const READERS: Readonly<Record<string, Read | undefined>> = {
  skel,
  axskel: skel,
  skin: readBy(skinReader, (character, skin) => ({ ...character, skins: [...character.skins, skin] })),
  morph: readBy(morphReader, (character, morph) => ({ ...character, morphs: [...character.morphs, morph] })),
  anim: readBy(animReader, (character, take, { shown }) => {
    const { skeleton, takes } = character;
    return { ...character, takes: [...takes, skeleton ? ownChannels(take, skeleton, shown.pose) : take] };
  }),
  bvh: readBy(bvhReader, (character, [capture], { shown }) => withCapture(character, capture, shown)),
  asf: readBy(asfReader, (character, skeleton) => ({ ...character, skeleton })),
  amc({ character, name, bytes, diagnostics }) {
    const report = new Report(name);
    const take = character.skeleton && readAmc(bytes, report, stemOfName(name), character.skeleton);
    diagnostics.push(...report.finish());
    return take ? { ...character, takes: [...character.takes, take] } : character;
  },
  trc({ character, name, bytes, shown }) {
    const budget = new Budget(bytes.length, (message) => {
      throw new RangeError(message);
    });
    return withCapture(character, pointCapture(stemOfName(name), readTrc(bytes, budget, new Remarks(name))), shown);
  },
};

function readBy<T>(
  reader: (name: string, byteLength?: number) => Reader<T>,
  add: (character: Character, value: T, reading: Reading) => Character,
): Read {
  return (reading) => {
    const { character, name, bytes, diagnostics } = reading;
    const { value, diagnostics: told } = readWhole(reader(name, bytes.length), bytes);
    diagnostics.push(...told);
    return value === undefined ? character : add(character, value, reading);
  };
}

function withCapture(character: Character, { skeleton: own, take }: Capture, { positions }: Shown): Character {
  const { skeleton = positions ? withPositions(own, positions) : own, takes } = character;
  return { ...character, skeleton, takes: take ? [...takes, take] : takes };
}
