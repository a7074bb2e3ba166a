using System.Buffers.Binary;
using System.Security.Cryptography;

namespace FractalEngine.Core.Physics;

/// <summary>Computes a hash of the state of bodies, to compare runs bit for bit.</summary>
internal static class BodyStateHash
{
    // Three coordinates of the position, three of the velocity, and the scale with the sleep as its sign.
    private const int NumbersPerBody = 7;

    // Of the 32 bytes of a SHA-256.
    private const int HashBytes = 8;

    /// <summary>Hashes positions, velocities, scales and sleep of all bodies.</summary>
    /// <returns>16 hexadecimal digits.</returns>
    public static string Compute(IReadOnlyList<Body> bodies)
    {
        var bytes = new byte[bodies.Count * NumbersPerBody * sizeof(double)];
        var remaining = bytes.AsSpan();
        foreach (var body in bodies)
        {
            double[] numbers =
            [
                body.Position.X, body.Position.Y, body.Position.Z,
                body.Velocity.X, body.Velocity.Y, body.Velocity.Z,
                body.IsAsleep ? -body.Scale : body.Scale,
            ];
            foreach (var number in numbers)
            {
                BinaryPrimitives.WriteDoubleLittleEndian(remaining, number);
                remaining = remaining[sizeof(double)..];
            }
        }

        return Convert.ToHexStringLower(SHA256.HashData(bytes).AsSpan(0, HashBytes));
    }
}
