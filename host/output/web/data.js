/* Arrays of the page: base64 of what zlib or gzip packed, and the numbers in it (report_pack.h). */
function bytesOf(id) {
    const words = document.getElementById(id).textContent;
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(words);
    return Uint8Array.from(atob(words), (letter) => letter.charCodeAt(0));
}

/* The unpacked bytes of an element; format: "deflate" (zlib) or "gzip". */
async function unpack(id, format = "deflate") {
    const stream = new Blob([bytesOf(id)]).stream().pipeThrough(new DecompressionStream(format));
    return new Response(stream).arrayBuffer();
}

/* A library of the page as a module. */
async function library(id) {
    const url = URL.createObjectURL(new Blob([await unpack(id, "gzip")], {type: "text/javascript"}));
    const module = await import(url);
    URL.revokeObjectURL(url);
    return module;
}

/* Reads numbers one array after the other. */
class Reader {
    constructor(buffer) {
        this.bytes = new Uint8Array(buffer);
        this.at = 0;
    }

    take(n) {
        this.at += n;
        return this.bytes.subarray(this.at - n, this.at);
    }

    int16(n) {
        const out = new Int16Array(n), high = this.take(n), low = this.take(n);
        for (let k = 0, before = 0; k < n; ++k) {
            const small = high[k] << 8 | low[k];
            out[k] = before += small >>> 1 ^ -(small & 1);
            before = out[k];
        }
        return out;
    }

    int32(n) {
        const out = new Int32Array(n), part = [0, 1, 2, 3].map(() => this.take(n));
        for (let k = 0, before = 0; k < n; ++k) {
            const small = part[0][k] << 24 | part[1][k] << 16 | part[2][k] << 8 | part[3][k];
            out[k] = before += small >>> 1 ^ -(small & 1);
            before = out[k];
        }
        return out;
    }

    /* Bytes are copied, so that they are aligned. */
    float32(n) { return new Float32Array(this.take(4 * n).slice().buffer); }

    plainInt32(n) { return new Int32Array(this.take(4 * n).slice().buffer); }
}

/* An element with properties and children; words become text. */
function make(name, properties = {}, ...children) {
    const element = Object.assign(document.createElement(name), properties);
    element.append(...children);
    return element;
}

const PREFIXES = [[1e-12, "p"], [1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"], [1e6, "M"], [1e9, "G"]];
const PREFIXED = new Set(["Pa", "N", "m", "J", "Hz", "m/s", "s", "W", "N m"]);

/* Units that a quantity is shown in: [factor, name]. */
function unitsOf(unit) {
    if (!PREFIXED.has(unit)) return [[1, unit]];
    return PREFIXES.map(([factor, prefix]) => [factor, prefix + unit]);
}

/* The unit in which a value has one to three digits before the point. */
function unitFor(unit, most) {
    const known = unitsOf(unit), fits = known.filter(([factor]) => factor <= Math.abs(most) * (1 + 1e-9));
    return fits.length ? fits[fits.length - 1] : known.find(([factor]) => factor === 1);
}

function words(value, unit) {
    const [factor, name] = unitFor(unit, value);
    return `${Number((value / factor).toPrecision(4))}${name && name !== "-" ? " " + name : ""}`;
}
