using System.Buffers.Binary;
using System.Security.Cryptography;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics;

/// <summary>Computes a hash of the state of bodies, to compare runs bit for bit.</summary>
internal static class BodyStateHash
{
    // Three coordinates of the position, three of the velocity, and the scale with the sleep as its sign.
    private const int NumbersPerBody = 7;

    // Position, orientation, velocity, angular velocity and belt.
    private const int NumbersPerKinematic = 16;

    // The hash is shown as its first bytes, of the 32 of a SHA-256.
    private const int HashBytes = 8;

    /// <summary>Hashes positions, velocities, scales and sleep of all bodies, and the motions of all objects that move.</summary>
    /// <returns>16 hexadecimal digits.</returns>
    public static string Compute(IReadOnlyList<Body> bodies, IReadOnlyList<KinematicObject> kinematics)
    {
        var bytes = new byte[((bodies.Count * NumbersPerBody) + (kinematics.Count * NumbersPerKinematic)) * sizeof(double)];
        var remaining = bytes.AsSpan();
        foreach (var body in bodies)
        {
            double[] numbers =
            [
                body.Position.X, body.Position.Y, body.Position.Z,
                body.Velocity.X, body.Velocity.Y, body.Velocity.Z,
                body.IsAsleep ? -body.Scale : body.Scale,
            ];
            remaining = Write(numbers, remaining);
        }

        foreach (var moved in kinematics)
        {
            double[] numbers =
            [
                moved.Pose.Position.X, moved.Pose.Position.Y, moved.Pose.Position.Z,
                moved.Pose.Orientation.Cosine,
                moved.Pose.Orientation.Axis.X, moved.Pose.Orientation.Axis.Y, moved.Pose.Orientation.Axis.Z,
                moved.Velocity.X, moved.Velocity.Y, moved.Velocity.Z,
                moved.AngularVelocity.X, moved.AngularVelocity.Y, moved.AngularVelocity.Z,
                moved.Belt.X, moved.Belt.Y, moved.Belt.Z,
            ];
            remaining = Write(numbers, remaining);
        }

        return Convert.ToHexStringLower(SHA256.HashData(bytes).AsSpan(0, HashBytes));
    }

    private static Span<byte> Write(double[] numbers, Span<byte> remaining)
    {
        foreach (var number in numbers)
        {
            BinaryPrimitives.WriteDoubleLittleEndian(remaining, number);
            remaining = remaining[sizeof(double)..];
        }

        return remaining;
    }
}
