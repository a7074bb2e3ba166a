using System.Globalization;
using FractalEngine.Core.Physics;

namespace FractalEngine.App;

/// <summary>
/// What bodies do, as comma-separated values (RFC 4180, but lines end in a line feed): a row for each body and step. Numbers are invariant,
/// with all digits.
/// </summary>
/// <param name="writer">Receives the text.</param>
internal sealed class BodyCsvWriter(TextWriter writer)
{
    /// <summary>The names of the columns.</summary>
    public const string Header = "time,body,x,y,z,vx,vy,vz,asleep,faceTests";

    /// <summary>Writes the names of the columns.</summary>
    public void WriteHeader() => Write(Header);

    /// <summary>Writes a row for each body as the last step left it.</summary>
    public void WriteStep(PhysicsWorld world)
    {
        foreach (var body in world.Bodies)
        {
            var (position, velocity) = (body.Position, body.Velocity);
            Write(string.Create(
                CultureInfo.InvariantCulture,
                $"{world.Time:R},{Quote(body.Name)},{position.X:R},{position.Y:R},{position.Z:R},{velocity.X:R},{velocity.Y:R},{velocity.Z:R},{(body.IsAsleep ? 1 : 0)},{body.FaceTests}"));
        }
    }

    /// <summary>A text as one field: in quotes where it would be more than one.</summary>
    public static string Quote(string text) =>
        text.AsSpan().ContainsAny(",\"\r\n") ? $"\"{text.Replace("\"", "\"\"", StringComparison.Ordinal)}\"" : text;

    private void Write(string line)
    {
        writer.Write(line);
        writer.Write('\n');
    }
}
