// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of numbers as pages hold them: base64 of little-endian bytes.

function bytesOf(text: string): ArrayBuffer {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}

export const readUint8 = (text: string): Uint8Array => new Uint8Array(bytesOf(text));
export const readUint16 = (text: string): Uint16Array => new Uint16Array(bytesOf(text));
export const readUint32 = (text: string): Uint32Array => new Uint32Array(bytesOf(text));
export const readFloat32 = (text: string): Float32Array => new Float32Array(bytesOf(text));
