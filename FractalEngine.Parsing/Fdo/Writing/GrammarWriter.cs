using System.Text;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>Writes the grammar of a mesh as a fractal file with named maps, powers and sums.</summary>
internal sealed class GrammarWriter(double length, Func<string, Mesh, string> fileOf)
{
    // What rounding of the numbers may change: entries of matrices, and translations in units of the whole's size.
    private const double RoundingTolerance = 2e-10;

    private const double AngleTolerance = 180 / Math.PI * RoundingTolerance;

    // Maps that differ by so little are powers of one.
    private const double RowTolerance = 1e-8;

    // Where the whole is smaller, so much rounding would show.
    private const double MinLengthOfShapes = 0.01;

    private readonly StringBuilder _declarations = new();
    private readonly StringBuilder _objects = new();
    private readonly List<(AffineMap Map, string Name)> _maps = [];
    private int _partCount;

    /// <summary>Returns the text of the file.</summary>
    /// <param name="grammar">What makes the mesh.</param>
    /// <param name="length">Diagonal of the whole, scene units; numbers are rounded by at most 2e-10 of it.</param>
    /// <param name="comments">Lines at the beginning, without the sign of a comment.</param>
    /// <param name="fileOf">Gives the file of a mesh, relative to the fractal file, by the mesh's name in the text.</param>
    public static string Write(MeshGrammar grammar, double length, IEnumerable<string> comments, Func<string, Mesh, string> fileOf)
    {
        var writer = new GrammarWriter(length, fileOf);
        var result = writer.WriteGrammar(grammar, "");
        var text = new StringBuilder();
        foreach (var comment in comments)
        {
            text.Append("# ").Append(comment).Append('\n');
        }

        return text.Append(writer._declarations).Append(writer._objects).Append("<$>. ").Append(result).Append('\n').ToString();
    }

    private static string Invariant(FormattableString text) => FormattableString.Invariant(text);

    /// <summary>Writes what a grammar is made of, and returns the term for it.</summary>
    /// <param name="grammar">The whole or a part.</param>
    /// <param name="suffix">End of the names that are declared for it: none of the whole, else the part's number.</param>
    private string WriteGrammar(MeshGrammar grammar, string suffix)
    {
        var leaf = grammar.Leaf is { } mesh ? WriteMesh("leaf" + suffix, mesh) : null;
        var terms = new List<string>();
        if (grammar.Base.FaceCount > 0 || grammar.Parts.Count == 0)
        {
            var name = WriteMesh(suffix.Length == 0 ? "base" : Invariant($"part{_partCount}"), grammar.Base);
            terms.Add(grammar.Tree is { } tree ? WriteTree(tree, name, leaf, suffix) : name);
        }

        terms.AddRange(grammar.Parts.Select(part => WriteGrammar(part, Invariant($"_{++_partCount}"))));
        var result = string.Join(" + ", terms);
        if (terms.Count > 1 && grammar.Steps.Count > 0)
        {
            _objects.Append(Invariant($"sum{suffix}. {result}\n"));
            result = "sum" + suffix;
        }

        for (var index = grammar.Steps.Count - 1; index >= 0; index--)
        {
            result = WriteStep(grammar.Steps[index], Invariant($"{index + 1}{suffix}"), result);
        }

        return result;
    }

    private string WriteMesh(string name, Mesh mesh)
    {
        // The maps of a shape are rounded in its own units.
        var text = length >= MinLengthOfShapes && BaseShapeSearch.Find(mesh) is var (shape, map)
            ? (IsIdentity(map) ? "" : $"[{NameOf(map)}] ") + shape
            : $"\"{fileOf(name, mesh)}\"";
        _objects.Append(Invariant($"{name}. {text}\n"));
        return name;
    }

    private string WriteStep(GrammarStep step, string number, string inner)
    {
        var sets = string.Join(' ', step.Sets.Select(set => $"[{SetText(set)}]"));
        if (step.Depth == 1)
        {
            return sets + " " + inner;
        }

        _objects.Append(Invariant($"inner{number}. {inner}\nlevel{number}<inner{number}>. {sets} inner{number}\n"));
        return Invariant($"level{number} {step.Depth}");
    }

    private string WriteTree(MapTree tree, string baseName, string? leaf, string suffix)
    {
        if (tree.IsFull)
        {
            var maps = Names(tree.Maps);
            var end = leaf ?? "end" + suffix;
            var endText = leaf is null ? Invariant($"{end}. {baseName}\n") : "";
            _objects.Append(endText + Invariant($"tree{suffix}<{end}>. [{maps}] {end} + {baseName}\n"));
            return Invariant($"tree{suffix} {tree.Depth}");
        }

        // One recursive for all maps that the same maps may follow.
        var rows = tree.Follows.Select(row => string.Join(' ', row)).ToArray();
        var states = rows.Distinct().Where(row => row.Length > 0).ToList();
        var heads = new List<string>();
        var bodies = new List<string>();
        for (var state = 0; state < states.Count; state++)
        {
            _objects.Append(Invariant($"end{state + 1}{suffix}. {leaf ?? baseName}\n"));
            heads.Add(Invariant($"tree{state + 1}{suffix}<end{state + 1}{suffix}>"));
            var following = tree.Follows[Array.IndexOf(rows, states[state])];
            var terms = following.GroupBy(map => states.IndexOf(rows[map])).Select(group =>
                $"[{Names(group.Select(map => tree.Maps[map]))}] {(group.Key < 0 ? baseName : Invariant($"end{group.Key + 1}{suffix}"))}");
            bodies.Add(string.Join(" + ", terms.Append(baseName)));
        }

        _objects.Append(string.Join(", ", heads)).Append(". ").Append(string.Join(", ", bodies)).Append('\n');
        return Invariant($"tree{states.IndexOf(rows[^1]) + 1}{suffix} {tree.Depth}");
    }

    private string Names(IEnumerable<AffineMap> maps) => string.Join(", ", maps.Select(NameOf));

    private string SetText(IReadOnlyList<AffineMap> maps)
    {
        if (maps.Count > 2 && MapRows.Find(maps, RowTolerance, length) is { } row)
        {
            var power = Invariant($"{NameOf(row.Map)}^0..{row.Count - 1}");
            return row.Others is [var only] && IsIdentity(only) ? power : $"{power}] [{SetText(row.Others)}";
        }

        return string.Join(", ", maps.Select(map => IsIdentity(map) ? "#" : NameOf(map)));
    }

    private bool IsIdentity(AffineMap map) => MapRows.AreNear(map, AffineMap.Identity, RoundingTolerance, length);

    private string NameOf(AffineMap map)
    {
        if (_maps.Find(known => MapRows.AreNear(known.Map, map, RoundingTolerance, length)) is { Name: { } knownName })
        {
            return knownName + ".";
        }

        var name = Invariant($"m{_maps.Count + 1}");
        _maps.Add((map, name));
        _declarations.Append(name).Append(MapText(map)).Append('\n');
        return name + ".";
    }

    private string MapText(AffineMap map)
    {
        var translation = Rounded(map.Translation, RoundingTolerance * length);
        if (Decompose(map.Linear) is { } parts)
        {
            var scale = parts.Scale == Vector.One ? "#"
                : parts.Scale.X == parts.Scale.Y && parts.Scale.Y == parts.Scale.Z ? $"({NumberText.Format(parts.Scale.X, 0)})"
                : VectorText(parts.Scale, 0);
            return $". ({Optional(translation)}, {Optional(parts.Rotation)}, {scale})";
        }

        return $".matrix {VectorText(map.Linear.V1, RoundingTolerance)} {VectorText(map.Linear.V2, RoundingTolerance)} "
            + $"{VectorText(map.Linear.V3, RoundingTolerance)} {VectorText(translation, 0)}";
    }

    /// <summary>Returns angles and scales with round numbers that make a matrix, or null where it has shear.</summary>
    private static (Vector Rotation, Vector Scale)? Decompose(Matrix linear)
    {
        var scale = new Vector(linear.V1.Length(), linear.V2.Length(), linear.V3.Length());
        // A mirror has one scale below 0; which one, decides on the rotation.
        return linear.Determinant() > 0
            ? Decompose(linear, scale)
            : new[] { scale with { Z = -scale.Z }, scale with { X = -scale.X }, scale with { Y = -scale.Y } }
                .Select(mirrored => Decompose(linear, mirrored)).MaxBy(parts => parts is { } found ? CountZeros(found.Rotation) : -1);
    }

    private static (Vector Rotation, Vector Scale)? Decompose(Matrix linear, Vector scale)
    {
        var axes = new Matrix(linear.V1 / scale.X, linear.V2 / scale.Y, linear.V3 / scale.Z);
        var angles = 180 / Math.PI * axes.EulerAngles();
        var rotation = Rounded(angles, AngleTolerance);
        // The same rotation with other angles, which are nicer where they are fewer.
        var other = Rounded(new(Wrapped(angles.X + 180), Wrapped(180 - angles.Y), Wrapped(angles.Z + 180)), AngleTolerance);
        rotation = CountZeros(other) > CountZeros(rotation) ? other : rotation;
        scale = Rounded(scale, RoundingTolerance);
        var made = rotation.LocalAxesFromDegrees() * Matrix.Diagonal(scale);
        return (made - linear).MaxAbsEntry() <= 4 * RoundingTolerance ? (rotation, scale) : null;
    }

    private static double Wrapped(double degrees) => degrees - (360 * Math.Round(degrees / 360));

    private static int CountZeros(Vector vector) => (vector.X == 0 ? 1 : 0) + (vector.Y == 0 ? 1 : 0) + (vector.Z == 0 ? 1 : 0);

    private static Vector Rounded(Vector vector, double tolerance) => new(
        NumberText.Round(vector.X, tolerance), NumberText.Round(vector.Y, tolerance), NumberText.Round(vector.Z, tolerance));

    private static string Optional(Vector vector) => vector == Vector.Zero ? "#" : VectorText(vector, 0);

    private static string VectorText(Vector vector, double tolerance) =>
        $"({NumberText.Format(vector.X, tolerance)}, {NumberText.Format(vector.Y, tolerance)}, {NumberText.Format(vector.Z, tolerance)})";
}
