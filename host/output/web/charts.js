/* Any sensor against any. */
const TIMES = {
    stage: ["stage", "-"],
    step: ["step", "-"],
    stage_time: ["time or load factor of the stage", ""],
    time_s: ["time", "s"]
};
const TOOLS = {
    feature: {dataZoom: {title: {zoom: "zoom", back: "back"}}, restore: {title: "all"}, saveAsImage: {title: "picture"}}
};

/* A number of an axis: powers of ten where digits would be many zeros. */
function numeral(value) {
    const short = Number(value.toPrecision(6)), size = Math.abs(short);
    return size !== 0 && (size < 1e-3 || size >= 1e6) ? short.toExponential().replace("e+", "e") : String(short);
}

/* What all charts share; names stand along their axes, so that they meet no number. */
function axisOf(name, more = {}) {
    return {
        type: "value",
        name,
        nameLocation: "middle",
        nameGap: 30,
        scale: true,
        axisLine: {show: true, onZero: false},
        axisTick: {show: true},
        minorTick: {show: true},
        axisLabel: {formatter: numeral, hideOverlap: true},
        ...more
    };
}

function chartIn(echarts, place, height) {
    const box = make("div", {className: "chart"});
    if (height) box.style.height = `${height}px`;
    place.append(box);
    const chart = echarts.init(box);
    new ResizeObserver(() => chart.resize()).observe(box);
    return chart;
}

class Curves {
    constructor(place, head, buffer) {
        this.place = place;
        this.head = head;
        const all = new Float32Array(buffer), n = head.rows;
        this.columns = head.name
                           .map((name, k) => {
                               const [words, unit] = TIMES[name] || [name, head.unit[k]];
                               return {name, words, unit, values: all.subarray(k * n, (k + 1) * n)};
                           })
                           .filter((column) => !(column.name === "time_s" && column.values.every((v) => v === 0)));
        this.axes = {};
    }

    find(name) { return this.columns.find((column) => column.name === name); }

    start(echarts) {
        const sensors = this.columns.filter((column) => !(column.name in TIMES));
        if (sensors.length === 0) return;
        const known = (name) => name && this.find(name);
        const first = {
            x: known(this.head.x) || known("time_s") || known("stage_time"),
            y: known(this.head.y) || sensors[0]
        };
        this.place.append(make("h2", {textContent: "Curves"}));
        const row = make("div", {className: "controls"});
        for (const axis of ["y", "x"]) row.append(...this.makeAxis(axis, first[axis]));
        row.append(make("span", {
            className: "small",
            textContent: this.head.every > 1 ? `every ${this.head.every}th sample` : "wheel or the box tool: zoom"
        }));
        this.place.append(row);
        this.chart = chartIn(echarts, this.place);
        this.draw();
    }

    makeAxis(axis, column) {
        const sensor = make(
            "select", {id: `sensor-${axis}`},
            ...this.columns.map(({name, words}) => make("option", {value: name, textContent: words})));
        const unit = make("select", {id: `unit-${axis}`});
        sensor.value = column.name;
        const offer = () => {
            const of = this.find(sensor.value).unit;
            unit.replaceChildren(
                make("option", {value: "0", textContent: "unit: automatic"}),
                ...unitsOf(of).map(([value, textContent]) => make("option", {value, textContent})));
            unit.hidden = unitsOf(of).length < 2;
        };
        offer();
        sensor.onchange = () => {
            offer();
            this.draw();
        };
        unit.onchange = () => this.draw();
        this.axes[axis] = {sensor, unit};
        return [make("label", {}, axis === "y" ? "up" : "across", sensor), unit];
    }

    /* Values of an axis in its unit and what stands beside it. */
    shown(axis) {
        const {sensor, unit} = this.axes[axis], column = this.find(sensor.value);
        const most = column.values.reduce((m, v) => Math.max(m, Math.abs(v) || 0), 0);
        const [factor, name] = Number(unit.value) ? unitsOf(column.unit).find(([f]) => f === Number(unit.value)) :
                                                    unitFor(column.unit, most || 1);
        return {
            values: column.values,
            factor,
            label: name && name !== "-" ? `${column.words} [${name}]` : column.words
        };
    }

    draw() {
        const x = this.shown("x"), y = this.shown("y");
        this.points = Array.from(x.values, (v, k) => [v / x.factor, y.values[k] / y.factor])
                          .map((point) => point.map((v) => Number.isFinite(v) ? v : null));
        this.chart.setOption(
            {
                animation: false,
                grid: {left: 80, right: 30, top: 40, bottom: 60},
                toolbox: TOOLS,
                tooltip: {trigger: "axis", axisPointer: {type: "cross"}},
                xAxis: axisOf(x.label),
                yAxis: axisOf(y.label, {nameGap: 60}),
                dataZoom: [
                    {type: "inside", xAxisIndex: 0, filterMode: "none"},
                    {type: "inside", yAxisIndex: 0, filterMode: "none"}
                ],
                series: [
                    {
                        type: "line",
                        name: y.label,
                        data: this.points,
                        showSymbol: this.points.length < 60,
                        symbolSize: 5,
                        lineStyle: {width: 1.6},
                        color: "#27517d",
                        large: true
                    },
                    {type: "scatter", name: "frame", data: this.marked(), symbolSize: 11, color: "#b2332b"}
                ],
            },
            true);
    }

    /* The sample nearest to the frame of the view. */
    marked() {
        if (this.sample === undefined) return [];
        const point = this.points[this.sample];
        return point.includes(null) ? [] : [point];
    }

    mark(frame) {
        const stage = this.find("stage").values, time = this.find("stage_time").values;
        let best = Infinity;
        for (let k = 0; k < stage.length; ++k) {
            const far = stage[k] === frame.stage ? Math.abs(time[k] - frame.stage_time) : Infinity;
            if (far < best) [best, this.sample] = [far, k];
        }
        if (this.chart) this.chart.setOption({series: [{}, {data: this.marked()}]});
    }
}
