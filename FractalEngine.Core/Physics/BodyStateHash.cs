using System.Security.Cryptography;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics;

/// <summary>Computes a hash of the state of bodies, to compare runs bit for bit.</summary>
internal static class BodyStateHash
{
    // The hash is shown as its first bytes, of the 32 of a SHA-256.
    private const int HashBytes = 8;

    /// <summary>Hashes positions, velocities, scales and sleep of all bodies, and the motions of all objects that move.</summary>
    /// <returns>16 hexadecimal digits.</returns>
    public static string Compute(IReadOnlyList<Body> bodies, IReadOnlyList<KinematicObject> kinematics)
    {
        using var state = new MemoryStream();
        // It writes numbers in the order of little-endian machines on all of them.
        using var writer = new BinaryWriter(state);
        foreach (var body in bodies)
        {
            Write(writer, body.Position, body.Velocity);
            writer.Write(body.IsAsleep ? -body.Scale : body.Scale);
        }

        foreach (var moved in kinematics)
        {
            Write(writer, moved.Pose.Position);
            writer.Write(moved.Pose.Orientation.Cosine);
            Write(writer, moved.Pose.Orientation.Axis, moved.Velocity, moved.AngularVelocity, moved.Belt);
        }

        return Convert.ToHexStringLower(SHA256.HashData(state.ToArray()).AsSpan(0, HashBytes));
    }

    private static void Write(BinaryWriter writer, params ReadOnlySpan<Vector> vectors)
    {
        foreach (var vector in vectors)
        {
            writer.Write(vector.X);
            writer.Write(vector.Y);
            writer.Write(vector.Z);
        }
    }
}
