using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Fittings of rooms, as shapes that stand on walls; their backs have no faces.</summary>
internal static class Fittings
{
    /// <summary>Adds a bare rectangle of wall: 2 faces.</summary>
    public static void AddWall(this MeshBuilder mesh, WallFrame frame, WallArea area) => mesh.AddQuad(
        frame.At(area.X0, area.Y0), frame.At(area.X1, area.Y0), frame.At(area.X1, area.Y1), frame.At(area.X0, area.Y1));

    /// <summary>Adds a plate with slanting edges: 10 faces.</summary>
    public static void AddPlate(this MeshBuilder mesh, WallFrame frame, WallArea area, double height, double bevel)
    {
        // Small plates have small bevels, so that they never turn inside out.
        var top = area.Inset(Math.Min(bevel, 0.3 * Math.Min(area.Width, area.Height)));
        var low = Corners(frame, area, 0);
        var high = Corners(frame, top, height);
        mesh.AddQuad(high[0], high[1], high[2], high[3]);
        for (var i = 0; i < 4; i++)
        {
            mesh.AddQuad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
        }
    }

    /// <summary>Adds the head of a bolt with six sides and a domed top: 24 faces.</summary>
    public static void AddBolt(this MeshBuilder mesh, WallFrame frame, double x, double y, double radius)
    {
        var tip = frame.At(x, y, 1.0 * radius);
        for (var i = 0; i < 6; i++)
        {
            var a = Around(i, 1, 0);
            var b = Around(i + 1, 1, 0);
            var c = Around(i + 1, 0.85, 0.8);
            var d = Around(i, 0.85, 0.8);
            mesh.AddQuad(a, b, c, d);
            mesh.AddTriangle(
                new(mesh.AddPosition(d), mesh.AddTextureCoordinate(0, 0)),
                new(mesh.AddPosition(c), mesh.AddTextureCoordinate(1, 0)),
                new(mesh.AddPosition(tip), mesh.AddTextureCoordinate(0.5, 1)));
        }

        Vector Around(int corner, double relativeRadius, double height)
        {
            var (s, c) = Math.SinCos(Math.PI * corner / 3);
            return frame.At(x + (relativeRadius * radius * c), y + (relativeRadius * radius * s), height * radius);
        }
    }

    /// <summary>Adds a smooth tube along a line of points, open at its ends: twice the sides times the segments in faces.</summary>
    /// <param name="mesh">Receives the faces.</param>
    /// <param name="points">Points of the line, at least two, no two in a row the same.</param>
    /// <param name="radius">Computes the radius at the point of an index.</param>
    /// <param name="sides">Number of sides, at least three.</param>
    public static void AddTube(this MeshBuilder mesh, IReadOnlyList<Vector> points, Func<int, double> radius, int sides)
    {
        var axes = SectionAxes(points);
        var corners = new MeshCorner[points.Count, sides + 1];
        mesh.AddCorners(
            corners, GridClosure.Columns, PositionAt, (point, side) => ((double)side / sides, (double)point / (points.Count - 1)));
        mesh.SmoothingGroup = 1;
        mesh.AddGrid(corners);
        mesh.SmoothingGroup = 0;

        Vector PositionAt(int point, int side)
        {
            var (right, up) = axes[point];
            var (s, c) = Math.SinCos(2 * Math.PI * side / sides);
            return points[point] + (radius(point) * ((c * right) + (s * up)));
        }
    }

    /// <summary>Computes the axes of a tube's sections, each carried on from the one before, so that the tube does not twist.</summary>
    private static (Vector Right, Vector Up)[] SectionAxes(IReadOnlyList<Vector> points)
    {
        var axes = new (Vector Right, Vector Up)[points.Count];
        for (var i = 0; i < points.Count; i++)
        {
            var tangent = (points[Math.Min(i + 1, points.Count - 1)] - points[Math.Max(i - 1, 0)]).UnitVector();
            var start = i > 0 ? axes[i - 1].Right : Math.Abs(tangent.Y) < 0.9 ? Vector.J : Vector.I;
            var right = (start - (Vector.Dot(start, tangent) * tangent)).UnitVector();
            axes[i] = (right, Vector.Cross(tangent, right));
        }

        return axes;
    }

    /// <summary>Adds a smooth ring that lies on a wall: twice the sides times the segments in faces.</summary>
    /// <param name="mesh">Receives the faces.</param>
    /// <param name="frame">Frame on the wall.</param>
    /// <param name="x">Centre of the ring along the frame's right axis.</param>
    /// <param name="y">Centre of the ring along the frame's up axis.</param>
    /// <param name="radius">Radius from the ring's centre to that of its section.</param>
    /// <param name="thickness">Radius of the section.</param>
    /// <param name="segments">Number of segments around the ring.</param>
    /// <param name="sides">Number of sides of the section.</param>
    public static void AddRing(
        this MeshBuilder mesh, WallFrame frame, double x, double y, double radius, double thickness, int segments, int sides)
    {
        var corners = new MeshCorner[segments + 1, sides + 1];
        mesh.AddCorners(
            corners, GridClosure.RowsAndColumns, PositionAt, (segment, side) => ((double)side / sides, (double)segment / segments));
        mesh.SmoothingGroup = 1;
        mesh.AddGrid(corners, isMirrored: true);
        mesh.SmoothingGroup = 0;

        Vector PositionAt(int segment, int side)
        {
            var (s, c) = Math.SinCos(2 * Math.PI * segment / segments);
            var (height, radialOffset) = Math.SinCos(2 * Math.PI * side / sides);
            var distance = radius + (thickness * radialOffset);
            return frame.At(x + (distance * c), y + (distance * s), thickness * height);
        }
    }

    private static Vector[] Corners(WallFrame frame, WallArea area, double height) =>
    [
        frame.At(area.X0, area.Y0, height), frame.At(area.X1, area.Y0, height),
        frame.At(area.X1, area.Y1, height), frame.At(area.X0, area.Y1, height),
    ];
}
