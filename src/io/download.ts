/** Hands a file to the person, through the browser's own download. */
export function download(name: string, content: string | Uint8Array<ArrayBuffer> | Blob): void {
  const type = typeof content === 'string' ? 'text/plain' : 'application/octet-stream';
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  URL.revokeObjectURL(url);
}
