using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.Support;

/// <summary>Fractals of the assets as numbered vectors say them: sets of two in place of one set of powers.</summary>
internal static class OldForms
{
    public static FractalDescription Read(string name)
    {
        var path = Repository.Full($"FractalEngine.Tests/Parsing/Fdo/OldForms/{name}.fdo");
        return FractalParser.Parse(SourceText.Read(path, path, 1 << 20)).Description;
    }

    public static Fractal Load(string name) => new(Read(name), AssetFractals.Load(name).BaseMesh);
}
