using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>The parts that rooms are fitted out with. Their backs stand on walls and have no faces.</summary>
internal static class Fittings
{
    /// <summary>A bare piece of wall: 2 faces.</summary>
    public static void AddWall(this MeshBuilder mesh, WallFrame frame, WallArea area) => mesh.AddQuad(
        frame.At(area.X0, area.Y0), frame.At(area.X1, area.Y0), frame.At(area.X1, area.Y1), frame.At(area.X0, area.Y1));

    /// <summary>A plate with slanting edges: 10 faces.</summary>
    public static void AddPlate(this MeshBuilder mesh, WallFrame frame, WallArea area, double height, double bevel)
    {
        // Small plates get small edges, so that they never turn inside out.
        var top = area.Inset(Math.Min(bevel, 0.3 * Math.Min(area.Width, area.Height)));
        Vector[] low = Corners(frame, area, 0), high = Corners(frame, top, height);
        mesh.AddQuad(high[0], high[1], high[2], high[3]);
        for (var i = 0; i < 4; i++)
        {
            mesh.AddQuad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
        }
    }

    /// <summary>The head of a bolt with six sides and a domed middle: 24 faces.</summary>
    public static void AddBolt(this MeshBuilder mesh, WallFrame frame, double x, double y, double radius)
    {
        var tip = frame.At(x, y, 1.0 * radius);
        for (var i = 0; i < 6; i++)
        {
            Vector a = Around(i, 1, 0), b = Around(i + 1, 1, 0), c = Around(i + 1, 0.85, 0.8), d = Around(i, 0.85, 0.8);
            mesh.AddQuad(a, b, c, d);
            mesh.AddTriangle(
                new(mesh.AddPosition(d), mesh.AddTextureCoordinate(0, 0)), new(mesh.AddPosition(c), mesh.AddTextureCoordinate(1, 0)),
                new(mesh.AddPosition(tip), mesh.AddTextureCoordinate(0.5, 1)));
        }

        Vector Around(int corner, double reach, double height) => Math.SinCos(Math.PI * corner / 3) switch
        {
            var (s, c) => frame.At(x + (reach * radius * c), y + (reach * radius * s), height * radius),
        };
    }

    /// <summary>A tube along a line of points, open at its ends; smooth. Faces: twice sides times pieces.</summary>
    /// <param name="mesh">Receives the faces.</param>
    /// <param name="points">At least two, no two in a row the same.</param>
    /// <param name="radius">At each point.</param>
    /// <param name="sides">At least three.</param>
    public static void AddTube(this MeshBuilder mesh, IReadOnlyList<Vector> points, Func<int, double> radius, int sides)
    {
        var corners = new MeshCorner[points.Count, sides + 1];
        var right = Vector.Zero;
        for (var i = 0; i < points.Count; i++)
        {
            var tangent = (points[Math.Min(i + 1, points.Count - 1)] - points[Math.Max(i - 1, 0)]).UnitVector();
            // The section's axes are carried along, so that the tube does not twist.
            var start = i == 0 ? (Math.Abs(tangent.Y) < 0.9 ? Vector.J : Vector.I) : right;
            right = (start - (Vector.Dot(start, tangent) * tangent)).UnitVector();
            var up = Vector.Cross(tangent, right);
            for (var side = 0; side <= sides; side++)
            {
                var (s, c) = Math.SinCos(2 * Math.PI * side / sides);
                var position = side == sides
                    ? corners[i, 0].PositionIndex
                    : mesh.AddPosition(points[i] + (radius(i) * ((c * right) + (s * up))));
                corners[i, side] = new(position, mesh.AddTextureCoordinate((double)side / sides, (double)i / (points.Count - 1)));
            }
        }

        mesh.SmoothingGroup = 1;
        mesh.AddGrid(corners);
        mesh.SmoothingGroup = 0;
    }

    /// <summary>A ring that lies on a wall, smooth. Faces: twice sides times pieces.</summary>
    public static void AddRing(this MeshBuilder mesh, WallFrame frame, double x, double y, double radius, double thickness, int segments,
        int sides)
    {
        var corners = new MeshCorner[segments + 1, sides + 1];
        for (var segment = 0; segment <= segments; segment++)
        {
            for (var side = 0; side <= sides; side++)
            {
                var (s, c) = Math.SinCos(2 * Math.PI * segment / segments);
                var (height, radialOffset) = Math.SinCos(2 * Math.PI * side / sides);
                var distance = radius + (thickness * radialOffset);
                var position = segment == segments ? corners[0, side].PositionIndex
                    : side == sides ? corners[segment, 0].PositionIndex
                    : mesh.AddPosition(frame.At(x + (distance * c), y + (distance * s), thickness * height));
                corners[segment, side] = new(position, mesh.AddTextureCoordinate((double)side / sides, (double)segment / segments));
            }
        }

        mesh.SmoothingGroup = 1;
        for (var segment = 0; segment < segments; segment++)
        {
            for (var side = 0; side < sides; side++)
            {
                mesh.AddQuad(corners[segment, side], corners[segment + 1, side], corners[segment + 1, side + 1],
                    corners[segment, side + 1]);
            }
        }

        mesh.SmoothingGroup = 0;
    }

    private static Vector[] Corners(WallFrame frame, WallArea area, double height) =>
    [
        frame.At(area.X0, area.Y0, height), frame.At(area.X1, area.Y0, height),
        frame.At(area.X1, area.Y1, height), frame.At(area.X0, area.Y1, height),
    ];
}
