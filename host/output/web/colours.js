/* Colours of values: the path through OKLab of colour.c, and one hue for each fragment. */
function fromOklab(lightness, chroma, hue) {
    const a = chroma * Math.cos(hue * Math.PI / 180), b = chroma * Math.sin(hue * Math.PI / 180);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
    const linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s
    ];
    return linear.map((v) => {
        const x = Math.min(Math.max(v, 0), 1);
        return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
    });
}

/* 256 colours, red green blue one after the other. */
const LADDER = Float32Array.from({length: 256}, (_, k) => k / 255).reduce((all, t, k) => {
    all.set(fromOklab(0.27 + 0.65 * t, 0.086 + 0.05 * (2 * t - 1) ** 2, 295 - 190 * t), 3 * k);
    return all;
}, new Float32Array(768));

function ladderStyle() {
    const stop = (k) => `rgb(${[0, 1, 2].map((c) => Math.round(255 * LADDER[3 * k + c])).join(" ")})`;
    return `linear-gradient(to right, ${[0, 32, 64, 96, 128, 160, 192, 224, 255].map(stop).join(", ")})`;
}

/* Hues turn by the golden angle, so that neighbours in number differ; the largest fragment is grey. */
function fragmentColour(number, largest) {
    if (number === largest) return [0.72, 0.74, 0.77];
    return fromOklab(0.62 + 0.16 * (number * 0.382 % 1), 0.13, number * 137.508 % 360);
}
