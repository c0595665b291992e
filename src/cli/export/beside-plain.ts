/**
 * Files that are saved beside the plain file of a take with layers, goals or attachments. The plain file has the motion
 * that is seen; its base and its layers are no takes of their own.
 *
 *     walk.anim  walk.base.anim  walk.arm.anim  walk.layers.json   →   walk.base.anim, walk.arm.anim
 */
import { dirname } from 'node:path';
import { nameBeside } from '../../files/kinds.ts';
import { formatOf } from '../../files/readers.ts';
import { readWhole } from '../../formats/reader.ts';
import { baseName, type FileContent } from '../../model/files.ts';
import type { GivenPath } from '../paths.ts';
import { fileBytes } from '../read-file.ts';

/** Bases and layers whose plain file is among the files, too. */
export function besidePlain(files: readonly GivenPath[]): ReadonlySet<GivenPath> {
  const byPath = new Map(files.map((file) => [file.absolute.toLowerCase(), file]));
  return new Set(
    files.flatMap((file) => {
      const named = namedBy(file);
      const beside = (name: string) => byPath.get(`${dirname(file.absolute)}/${baseName(name)}`.toLowerCase());
      const plain = named && beside(named.plain);
      return plain ? named.parts.flatMap((name) => beside(name) ?? []).filter((part) => part !== plain) : [];
    }),
  );
}

/** Undefined for a file without controls, and one that can't be read, which opening it says. */
function namedBy({ path, absolute, bytes }: GivenPath) {
  const format = formatOf(path);
  if (format?.kind !== 'layers' && format?.kind !== 'limbs' && format?.kind !== 'attach') return undefined;
  const plain = `${nameBeside(baseName(path))}.anim`;
  let content: FileContent | undefined;
  try {
    content = readWhole<FileContent>(format.reader(baseName(path)), bytes ?? fileBytes(absolute)).value;
  } catch {
    return undefined;
  }
  switch (content?.kind) {
    case 'layers': {
      const { base, flattened, layers } = content.layers;
      return { plain: flattened?.file ?? plain, parts: [base, ...layers.map(({ file }) => file)] };
    }
    case 'limbs':
      return { plain: content.limbs.flattened?.file ?? plain, parts: content.limbs.base ? [content.limbs.base] : [] };
    case 'attach':
      return { plain: content.attach.flattened?.file ?? plain, parts: [content.attach.base] };
    default:
      return undefined;
  }
}
