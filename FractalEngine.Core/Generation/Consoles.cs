using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Generates consoles: a desk with keys that leans out of the wall, and screens above it.</summary>
internal static class Consoles
{
    private const double DeskHeight = 0.42;
    private const double DeskDepth = 0.4;

    /// <summary>Fills a rectangle of wall with a console.</summary>
    /// <param name="mesh">Receives the faces.</param>
    /// <param name="frame">Frame whose right axis points upwards in the room.</param>
    /// <param name="area">Rectangle in the frame: x upwards, y along the wall.</param>
    /// <param name="detail">Amount of detail, about proportional to the number of faces.</param>
    /// <param name="random">Source of chance for the keys and screens.</param>
    public static void Add(MeshBuilder mesh, WallFrame frame, WallArea area, double detail, SplitMix64 random)
    {
        var desk = area with { X1 = area.X0 + DeskHeight };
        // The desk: a front that leans towards the room, and a top that slopes down from the wall.
        var wallLow = Edge(desk.X0, 0);
        var frontLow = Edge(desk.X0, 0.5 * DeskDepth);
        var frontHigh = Edge(desk.X1 - 0.12, DeskDepth);
        var wallHigh = Edge(desk.X1 + 0.1, 0.06);
        Vector[][] outline = [wallLow, frontLow, frontHigh, wallHigh];
        for (var i = 0; i + 1 < outline.Length; i++)
        {
            mesh.AddQuad(outline[i][0], outline[i + 1][0], outline[i + 1][1], outline[i][1]);
        }

        mesh.AddQuad(wallLow[0], wallHigh[0], frontHigh[0], frontLow[0]);
        mesh.AddQuad(wallLow[1], frontLow[1], frontHigh[1], wallHigh[1]);
        AddKeys(mesh, frontHigh, wallHigh, detail, random);
        AddScreens(mesh, frame, area with { X0 = desk.X1 + 0.12 }, detail, random);

        // Both ends of an edge of the desk.
        Vector[] Edge(double x, double height) => [frame.At(x, desk.Y0, height), frame.At(x, desk.Y1, height)];
    }

    private static void AddKeys(MeshBuilder mesh, Vector[] front, Vector[] back, double detail, SplitMix64 random)
    {
        var along = front[1] - front[0];
        var away = back[0] - front[0];
        var top = new WallFrame(front[0], away.UnitVector(), along.UnitVector());
        var depth = away.Length();
        var width = along.Length();
        var size = Math.Max(0.012, 0.045 / Math.Sqrt(Math.Max(0.3, detail)));
        foreach (var block in new WallArea(0.03, 0.04, depth - 0.05, width - 0.04).Cells(1, 4))
        {
            var field = block.Inset(0.02);
            mesh.AddPlate(top, field, 0.008, 0.006);
            if (detail < WallPanels.MinFittingDetail)
            {
                continue;
            }

            var raised = top.Translated(0, 0, 0.008);
            var columns = Math.Max(2, (int)(field.Width / size));
            var rows = Math.Max(2, (int)(field.Height / size));
            foreach (var key in field.Inset(0.015).Cells(columns, rows))
            {
                if (random.Chance(0.9))
                {
                    mesh.AddPlate(raised, key.Inset(0.12 * Math.Min(key.Width, key.Height)), random.NextInRange(0.008, 0.014), 0.004);
                }
            }
        }
    }

    private static void AddScreens(MeshBuilder mesh, WallFrame frame, WallArea area, double detail, SplitMix64 random)
    {
        mesh.AddPlate(frame, area.Inset(0.01), 0.03, 0.02);
        var wall = frame.Translated(0, 0, 0.03);
        foreach (var screen in area.Inset(0.05).Cells(2, 3))
        {
            var outer = screen.Inset(0.02);
            mesh.AddPlate(wall, outer, 0.03, 0.015);
            if (random.Chance(0.7))
            {
                // Bars of a chart stand out of the glass by a hair.
                var bars = (int)Math.Clamp(6 * Math.Sqrt(detail), 2, 60);
                foreach (var bar in outer.Inset(0.04).Cells(1, bars))
                {
                    var shortened = bar with { X1 = bar.X0 + (bar.Width * random.NextInRange(0.2, 1)) };
                    mesh.AddPlate(wall.Translated(0, 0, 0.03), shortened.Inset(0.1 * bar.Height), 0.004, 0.002);
                }
            }
            else
            {
                mesh.AddPlate(wall.Translated(0, 0, 0.03), outer.Inset(0.03), 0.004, 0.003);
            }
        }
    }
}
