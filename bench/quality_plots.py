"""The two pictures of docs/benchmarks.md that show how clean prints come out."""

from judge import FIGURES, compares, figure
from peers import COMPARED


def plots(results, folder):
    """Two pictures of all models: smear and holes of every slicer, and both against time, as shares of PrusaSlicer's.
    results: {name: {(slicer, variant): judgement}}. Where another part was printed, the bars are hatched and the points left out."""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "cleancolor", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot
    from matplotlib.patches import Patch

    entries = [((slicer, variant), title.strip("*")) for slicer, variant, title in COMPARED]
    titles = [title for _, title in entries]
    palette = ["#56B4E9", "#0072B2", "#00528A", "#8CC7E8", "#E69F00", "#D55E00", "#A04000", "#D9D9D9", "#A5D6C5", "#009E73"]
    plot, axes = pyplot.subplots(2, 1, figsize=(9, 6), sharex=True, constrained_layout=True)
    for axis, (key, label, _) in zip(axes, FIGURES):
        for k, (row, title) in enumerate(entries):
            places = [m + (k - len(titles) / 2 + 0.5) * 0.09 for m in range(len(results))]
            bars = axis.bar(places, [figure(rows[row], key) for rows in results.values()], 0.09, color=palette[k])
            for bar, (name, rows) in zip(bars, results.items()):
                if not compares(name, rows, row):
                    bar.set(hatch="//////", edgecolor="white", linewidth=0)
        axis.set_ylabel(f"{label}, worst case")
        axis.set_yscale("symlog", linthresh=1)
        axis.grid(axis="y", alpha=0.3)
        axis.set_ylim(bottom=0)
    axes[1].set_xticks(range(len(results)), results.keys())
    axes[0].legend(handles=[Patch(color=c, label=t) for c, t in zip(palette, titles)], ncol=4, fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    plot.savefig(folder / "quality-figures.svg", metadata={"Date": None})
    pyplot.close(plot)

    plot, axis = pyplot.subplots(figsize=(9, 4.5), constrained_layout=True)
    def minutes(judged):
        return judged["print"]["time_s"] / 60

    def dirt(judged):
        return figure(judged, "smear_volume") + figure(judged, "hole_volume")

    for k, (row, title) in enumerate(entries):
        pairs = [(rows[row], rows["prusa", "plain"]) for name, rows in results.items() if compares(name, rows, row)]
        axis.scatter([100 * (minutes(own) / minutes(plain) - 1) for own, plain in pairs],
                     [100 * dirt(own) / dirt(plain) for own, plain in pairs], s=28, color=palette[k], label=title)
    axis.set_xlabel("print time, % over PrusaSlicer's plain print of the same model")
    axis.set_ylabel("smear + holes, worst case, % of its")
    axis.set_yscale("log")
    axis.grid(alpha=0.3)
    axis.legend(ncol=4, fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    plot.savefig(folder / "quality-time.svg", metadata={"Date": None})
    pyplot.close(plot)
