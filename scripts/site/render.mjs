// Reads [{tex, display}] from standard input and writes the HTML of each; a mistake in one is reported with its text.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';

const katex = createRequire(resolve(process.argv[2], 'package.json'))('katex');
const html = JSON.parse(readFileSync(0, 'utf8')).map(({ tex, display }) => {
  try {
    return katex.renderToString(tex, { displayMode: display, throwOnError: true, strict: 'error', output: 'htmlAndMathml' });
  } catch (error) {
    console.error(`no equation: ${tex}\n${error.message}`);
    process.exitCode = 1;
    return '';
  }
});
process.stdout.write(JSON.stringify(html));
