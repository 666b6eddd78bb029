// Text of a file as the editor has it, lines apart by "\n", and as the file has it.

export interface FileForm {
  eol: "\n" | "\r\n";
  /** Whether a mark of the byte order stands first, as some editors write it. */
  isMarked: boolean;
}

const mark = "\uFEFF";

/** @param raw  what the file holds; the line end that most of its lines have is its own */
export function formOf(raw: string): FileForm {
  const ends = raw.match(/\r?\n/g) ?? [];
  const isOfTwo = 2 * ends.filter((end) => end.length === 2).length > ends.length;
  return { eol: isOfTwo ? "\r\n" : "\n", isMarked: raw.startsWith(mark) };
}

export function normal(raw: string): string {
  return raw.replace(/^\uFEFF/, "").replace(/\r\n?/g, "\n");
}

/** @param text  with "\n" between lines */
export function written(text: string, { eol, isMarked }: FileForm): string {
  return (isMarked ? mark : "") + (eol === "\n" ? text : text.replace(/\n/g, eol));
}
