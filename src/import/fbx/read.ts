/** `.fbx` from version 7.0 on, binary or text. */
import { bytesReader, type Reader } from '../../formats/reader.ts';
import type { Scene } from '../scene.ts';
import { readFbxFile } from './records/read-file.ts';
import { sceneOf } from './to-scene.ts';

/** A reader of all that a file holds, as a scene. */
export function fbxReader(fileName: string): Reader<Scene> {
  return bytesReader(fileName, (bytes, report) => {
    const read = readFbxFile(bytes, report);
    const dot = fileName.lastIndexOf('.');
    return sceneOf(read.file, dot > 0 ? fileName.slice(0, dot) : fileName, read.report);
  });
}
