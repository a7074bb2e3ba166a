using FractalEngine.Core.Generation.Building;

namespace FractalEngine.Core.Generation;

/// <summary>Generates panelling: divides an area at random until its parts are small, and adds a fitting to each.</summary>
/// <param name="mesh">Receives the faces.</param>
/// <param name="detail">Amount of detail, about proportional to the number of faces; 0 gives one plate an area.</param>
internal sealed class WallPanels(MeshBuilder mesh, double detail)
{
    /// <summary>Minimum detail of fittings; below it plates stay bare.</summary>
    public const double MinFittingDetail = 0.02;

    private const double Gap = 0.008;
    private const double Bevel = 0.012;

    /// <summary>Adds plates, grilles, buttons and bolted covers of random sizes.</summary>
    public void AddPanels(WallFrame frame, WallArea area, SplitMix64 random) => Divide(area, MinPanelArea(0.05), random, part =>
    {
        var height = random.NextInRange(0.005, 0.05);
        mesh.AddPlate(frame, part.Inset(Gap), height, Bevel);
        AddFitting(frame.Translated(0, 0, height), part.Inset(Gap + Bevel + 0.01), random);
    });

    /// <summary>Adds a floor: two rows of plates with a tread of studs, and a drain along the centre line.</summary>
    public void AddFloor(WallFrame frame, WallArea area)
    {
        var half = 0.5 * area.Width;
        foreach (var part in area.Cells(2, 3))
        {
            var plate = part.X0 < area.X0 + (0.5 * half) ? part with { X1 = part.X1 - 0.06 } : part with { X0 = part.X0 + 0.06 };
            mesh.AddPlate(frame, plate.Inset(Gap), 0.01, Bevel);
            if (detail < MinFittingDetail)
            {
                continue;
            }

            // Studs lie across each other by turns, as on chequer plate.
            var isAcross = false;
            foreach (var stud in plate.Inset(0.05).Cells(CountAtDetail(3, 14), CountAtDetail(3, 12)))
            {
                var x = 0.5 * (stud.X0 + stud.X1);
                var y = 0.5 * (stud.Y0 + stud.Y1);
                var longer = 0.36 * Math.Min(stud.Width, stud.Height);
                var shorter = 0.1 * Math.Min(stud.Width, stud.Height);
                var (w, h) = isAcross ? (shorter, longer) : (longer, shorter);
                mesh.AddPlate(frame.Translated(0, 0, 0.01), new(x - w, y - h, x + w, y + h), 0.006, 0.004);
                isAcross = !isAcross;
            }
        }

        AddGrille(frame, new(area.X0 + half - 0.05, area.Y0, area.X0 + half + 0.05, area.Y1), 8);
    }

    /// <summary>Adds a ceiling: a long light between panels.</summary>
    public void AddCeiling(WallFrame frame, WallArea area, SplitMix64 random)
    {
        var x0 = area.X0 + (0.36 * area.Width);
        var x1 = area.X0 + (0.64 * area.Width);
        AddPanels(frame, area with { X1 = x0 }, random);
        AddPanels(frame, area with { X0 = x1 }, random);
        var light = new WallArea(x0, area.Y0, x1, area.Y1).Inset(0.02);
        mesh.AddPlate(frame, light, 0.05, 0.03);
        foreach (var tube in light.Inset(0.06).Cells(2, 1))
        {
            mesh.AddPlate(frame.Translated(0, 0, 0.05), tube.Inset(0.02), 0.03, 0.03);
        }
    }

    private void AddFitting(WallFrame frame, WallArea area, SplitMix64 random)
    {
        if (detail < MinFittingDetail || Math.Min(area.Width, area.Height) < 0.03)
        {
            return;
        }

        switch (random.Next() % 8)
        {
            case 0 or 1:
                AddGrille(frame, area.Inset(0.01), 3);
                break;
            case 2:
                AddButtons(frame, area.Inset(0.01), random);
                break;
            case 3 or 4:
                AddBolts(frame, area);
                break;
            case 5:
                Divide(area, MinPanelArea(0.012), random,
                    part => mesh.AddPlate(frame, part.Inset(0.003), random.NextInRange(0.004, 0.02), 0.004));
                break;
            case 6:
                var handle = 0.2 * Math.Min(area.Width, area.Height);
                var inset = area.Inset(0.25 * Math.Min(area.Width, area.Height));
                mesh.AddPlate(frame, inset, 0.008, 0.006);
                mesh.AddTube(
                    [
                        frame.At(inset.X0, inset.Y0, 0.006), frame.At(inset.X0, inset.Y0, 0.5 * handle),
                        frame.At(inset.X1, inset.Y0, 0.5 * handle), frame.At(inset.X1, inset.Y0, 0.006),
                    ],
                    _ => 0.006, 6);
                break;
            default:
                break;
        }
    }

    /// <summary>Adds a grille of slats across the shorter side.</summary>
    private void AddGrille(WallFrame frame, WallArea area, int minSlats)
    {
        var slats = CountAtDetail(minSlats, 4 * minSlats);
        foreach (var slat in area.Width > area.Height ? area.Cells(slats, 1) : area.Cells(1, slats))
        {
            mesh.AddPlate(frame, slat.Inset(0.12 * Math.Min(slat.Width, slat.Height)), 0.014, 0.25 * Math.Min(slat.Width, slat.Height));
        }
    }

    private void AddButtons(WallFrame frame, WallArea area, SplitMix64 random)
    {
        var size = Math.Max(0.02, 0.05 / Math.Sqrt(Math.Max(1, detail)));
        foreach (var cell in area.Cells(Math.Max(1, (int)(area.Width / size)), Math.Max(1, (int)(area.Height / size))))
        {
            if (random.Chance(0.8))
            {
                mesh.AddPlate(frame, cell.Inset(0.18 * Math.Min(cell.Width, cell.Height)), random.NextInRange(0.004, 0.012), 0.003);
            }
        }
    }

    private void AddBolts(WallFrame frame, WallArea area)
    {
        var inner = area.Inset(0.012);
        foreach (var (x, y) in ((double, double)[])[(inner.X0, inner.Y0), (inner.X1, inner.Y0), (inner.X1, inner.Y1), (inner.X0, inner.Y1)])
        {
            mesh.AddBolt(frame, x, y, 0.009);
        }
    }

    /// <summary>Splits an area near its centre, the longer side first, until the parts are small.</summary>
    private static void Divide(WallArea area, double minArea, SplitMix64 random, Action<WallArea> fit)
    {
        if (area.Width * area.Height < minArea * random.NextInRange(0.7, 2.4))
        {
            fit(area);
            return;
        }

        var (first, second) = area.Split(random.NextInRange(0.34, 0.66));
        Divide(first, minArea, random, fit);
        Divide(second, minArea, random, fit);
    }

    /// <summary>Computes the area in m² below which nothing is divided.</summary>
    /// <param name="atDetailOne">That area at detail 1.</param>
    private double MinPanelArea(double atDetailOne) => detail == 0 ? double.PositiveInfinity : atDetailOne / detail;

    private int CountAtDetail(int minCount, int atDetailOne) =>
        (int)Math.Clamp(minCount + ((atDetailOne - minCount) * Math.Sqrt(detail)), minCount, 100 * atDetailOne);
}
