using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>
/// One transformation function that makes all transformations of a set. Its outputs (position, rotation and scale) are each neutral, one
/// vector for all, or a parameter.
/// </summary>
internal sealed class FractalSetForm
{
    /// <summary>Index of the position among the outputs of a function.</summary>
    public const int Position = 0;

    /// <summary>Index of the rotation among the outputs of a function.</summary>
    public const int Rotation = 1;

    /// <summary>Index of the scale among the outputs of a function.</summary>
    public const int Scale = 2;

    private const int OutputCount = 3;
    private const string AllParameterNames = "abc";

    private readonly Transformation[] _transformations;
    private readonly OutputKind[] _outputKinds;

    /// <summary>Finds the function for a set.</summary>
    public FractalSetForm(TransformationSet set)
    {
        Set = set;
        _transformations = [.. set.Transformations.Where(transformation => !IsIdentity(transformation))];
        _outputKinds = [.. Enumerable.Range(0, OutputCount).Select(FindKind)];
    }

    private enum OutputKind
    {
        Neutral,
        Constant,
        Parameter,
    }

    /// <summary>Set that the function makes.</summary>
    public TransformationSet Set { get; }

    /// <summary>True if the set has transformations other than the identity, which needs no function.</summary>
    public bool HasTransformations => _transformations.Length > 0;

    /// <summary>Names of the parameters: a, b and c, as many as there are.</summary>
    public IEnumerable<char> ParameterNames => AllParameterNames.Take(_outputKinds.Count(kind => kind == OutputKind.Parameter));

    /// <summary>Returns whether a transformation has exactly the bits of the identity, which is written as '#'.</summary>
    public static bool IsIdentity(Transformation transformation) =>
        Enumerable.Range(0, OutputCount).All(output => IsNeutral(transformation, output));

    /// <summary>Returns the vectors that the function or its calls need for one output, in order and with repetitions.</summary>
    public IEnumerable<Vector> Vectors(int output) => _outputKinds[output] switch
    {
        OutputKind.Constant => [Part(_transformations[0], output)],
        OutputKind.Parameter => _transformations.Select(transformation => Part(transformation, output)),
        _ => [],
    };

    /// <summary>Returns the arguments with which the function makes one of the transformations.</summary>
    public IEnumerable<Vector> Arguments(Transformation transformation)
    {
        for (var output = 0; output < OutputCount; output++)
        {
            if (_outputKinds[output] == OutputKind.Parameter)
            {
                yield return Part(transformation, output);
            }
        }
    }

    /// <summary>Returns the three outputs of the function: '#', a vector, or the name of a parameter.</summary>
    /// <param name="formatVector">Formats a vector that is the same for the whole set.</param>
    public IEnumerable<string> Outputs(Func<Vector, string> formatVector)
    {
        var parameter = 0;
        for (var output = 0; output < OutputCount; output++)
        {
            yield return _outputKinds[output] switch
            {
                OutputKind.Constant => formatVector(Part(_transformations[0], output)),
                OutputKind.Parameter => $"{AllParameterNames[parameter++]}",
                _ => "#",
            };
        }
    }

    private OutputKind FindKind(int output)
    {
        if (_transformations.All(transformation => IsNeutral(transformation, output)))
        {
            return OutputKind.Neutral;
        }

        // With a parameter, sets of one transformation can share a function.
        var first = Part(_transformations[0], output);
        return _transformations.Length > 1 && _transformations.All(t => FractalVectors.AreBitEqual(Part(t, output), first))
            ? OutputKind.Constant
            : OutputKind.Parameter;
    }

    private static bool IsNeutral(Transformation transformation, int output) =>
        FractalVectors.AreBitEqual(Part(transformation, output), Part(Transformation.Identity, output));

    private static Vector Part(Transformation transformation, int output) => output switch
    {
        Position => transformation.Position,
        Rotation => transformation.Rotation,
        _ => transformation.Scale,
    };
}
