/* Sizes of fragments and directions of cracks. */
class Fragments {
    constructor(place, head, buffer) {
        this.place = place;
        this.head = head;
        this.masses = new Float32Array(buffer);
    }

    start(echarts) {
        this.place.append(make("h2", {textContent: "Fragment sizes"}));
        this.told = make("p", {className: "small"});
        this.place.append(this.told);
        this.chart = chartIn(echarts, this.place, 380);
        this.show(null);
    }

    /* Those of a frame by its number; null, or no such frame: the last ones known. */
    show(number) {
        const known = this.head.frame.indexOf(number), last = this.head.frame.length - 1;
        const of = known < 0 || (this.head.frame[last] === -1 && known === last - 1 && number === null) ? last : known;
        const masses = this.masses.subarray(this.head.start[of], this.head.start[of + 1]);
        const whole = masses.reduce((sum, m) => sum + m, 0), share = [], count = [];
        let below = whole;
        masses.forEach((m, k) => {
            share.push([m, 100 * below / whole]);
            count.push([m, k + 1]);
            below -= m;
        });
        this.told.textContent = `${masses.length} fragment${masses.length === 1 ? "" : "s"}` +
            (this.head.frame[of] < 0 ? " at the end of the run" : ` at frame ${this.head.frame[of]}`) +
            ` · largest ${(100 * masses[0] / whole).toPrecision(4)} % of the mass`;
        this.chart.setOption(
            {
                animation: false,
                grid: {left: 70, right: 70, top: 50, bottom: 60},
                legend: {top: 8},
                toolbox: TOOLS,
                tooltip: {trigger: "item"},
                xAxis: axisOf("mass of a fragment [kg]", {type: "log"}),
                yAxis: [
                    axisOf("share of the mass in fragments up to it [%]", {min: 0, max: 100, nameGap: 45}),
                    axisOf("fragments at least as heavy", {type: "log", nameGap: 45, min: 1, splitLine: {show: false}})
                ],
                series: [
                    {
                        type: "line",
                        name: "share of the mass",
                        step: "end",
                        data: share.reverse(),
                        color: "#27517d",
                        showSymbol: share.length < 60
                    },
                    {
                        type: "line",
                        name: "number",
                        yAxisIndex: 1,
                        data: count,
                        color: "#b2332b",
                        symbolSize: 5,
                        showSymbol: count.length < 60
                    }
                ],
            },
            true);
    }
}

const PLANES = [["yz", "y", "z", "x"], ["zx", "z", "x", "y"], ["xy", "x", "y", "z"]];

class Rose {
    constructor(place, areas) {
        this.place = place;
        this.areas = areas;
    }

    start(echarts) {
        this.place.append(make("h2", {textContent: "Crack rose"}));
        const plane = make(
            "select",
            {id: "plane", onchange: () => this.show(PLANES[plane.selectedIndex], this.areas[plane.selectedIndex])},
            ...PLANES.map(([name]) => make("option", {textContent: name})));
        plane.selectedIndex = 2;
        this.told = make("span", {className: "small"});
        this.place.append(make("div", {className: "controls"}, make("label", {}, "plane", plane), this.told));
        this.chart = chartIn(echarts, this.place, 380);
        plane.onchange();
    }

    show([, across, up, along], area) {
        const whole = area.reduce((sum, a) => sum + a, 0), n = area.length, step = 180 / n;
        const parts = [...area, ...area].map((a) => whole > 0 ? 100 * a / whole : 0);
        this.told.textContent = `share of the crack area by the direction of its trace, seen along ${along}; ` +
            `0°: ${across}, 90°: ${up}; area seen ${(whole * 1e6).toPrecision(3)} mm²`;
        this.chart.setOption(
            {
                animation: false,
                polar: {radius: "78%"},
                toolbox: {feature: {saveAsImage: {title: "picture"}}},
                tooltip: {
                    formatter: (p) =>
                        `${p.dataIndex % n * step}° to ${(p.dataIndex % n + 1) * step}°: ${p.value.toFixed(2)} %`
                },
                angleAxis: {
                    type: "category",
                    startAngle: 0,
                    clockwise: false,
                    data: parts.map((_, k) => `${k * step}°`),
                    axisLabel: {interval: 2, align: "center"},
                    boundaryGap: true
                },
                radiusAxis: {
                axisLabel: {formatter: "{value} %", showMaxLabel: false, backgroundColor: "rgba(255, 255, 255, 0.75)"},
                splitNumber: 3,
                z: 10
            },
                series: [{type: "bar", coordinateSystem: "polar", data: parts, barCategoryGap: "6%", color: "#27517d"}],
            },
            true);
    }
}
