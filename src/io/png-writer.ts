/** Frames as PNGs in a zip, numbered so that other programs take them as a sequence. Loaded on first use. */
import type { FrameCanvas, FrameWriter } from './frame-writer.ts';
import { type ZippedFile, zipFiles } from './zip-files.ts';

/** Of the frame's number: as many as its programs expect. */
const DIGITS = 4;

export function pngWriter({ canvas }: FrameCanvas, name: string): FrameWriter {
  const files: ZippedFile[] = [];
  return {
    async add() {
      const number = String(files.length).padStart(DIGITS, '0');
      const content = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
      files.push({ name: `${name}_${number}.png`, content });
    },
    end: async () => new Blob([zipFiles(name, files)], { type: 'application/zip' }),
    async cancel() {},
  };
}
