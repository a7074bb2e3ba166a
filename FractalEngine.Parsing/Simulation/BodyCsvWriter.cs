using System.Globalization;
using FractalEngine.Core.Physics;

namespace FractalEngine.Parsing.Simulation;

/// <summary>
/// Writes the states of bodies as comma-separated values, one row per body and step. Numbers are invariant and round-trip.
/// </summary>
/// <remarks>The format is that of RFC 4180, except that lines end in a single line feed.</remarks>
/// <param name="writer">The writer that receives the text.</param>
public sealed class BodyCsvWriter(TextWriter writer)
{
    /// <summary>The header row with the column names.</summary>
    public const string Header = "time,body,x,y,z,vx,vy,vz,asleep,faceTests,wx,wy,wz,rx,ry,rz";

    /// <summary>Writes the header row.</summary>
    public void WriteHeader() => writer.Write($"{Header}\n");

    /// <summary>Writes one row per body with its state after the last step.</summary>
    public void WriteStep(PhysicsWorld world)
    {
        foreach (var body in world.Bodies)
        {
            var position = body.Position;
            var velocity = body.Velocity;
            var asleep = body.IsAsleep ? 1 : 0;
            writer.Write(string.Create(
                CultureInfo.InvariantCulture, $"{world.Time:R},{Quote(body.Name)},{position.X:R},{position.Y:R},{position.Z:R},"));
            writer.Write(string.Create(
                CultureInfo.InvariantCulture, $"{velocity.X:R},{velocity.Y:R},{velocity.Z:R},{asleep},{body.FaceTests},"));
            var spin = body.AngularVelocity;
            var turn = body.Orientation.RotationVector;
            writer.Write(string.Create(
                CultureInfo.InvariantCulture, $"{spin.X:R},{spin.Y:R},{spin.Z:R},{turn.X:R},{turn.Y:R},{turn.Z:R}\n"));
        }
    }

    /// <summary>Formats a text as one field, in quotes where it contains a comma, a quote or a line break.</summary>
    public static string Quote(string text) =>
        text.AsSpan().ContainsAny(",\"\r\n") ? $"\"{text.Replace("\"", "\"\"", StringComparison.Ordinal)}\"" : text;
}
