/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <istream>
#include <string>
#include <vector>

/** \file
 * Comma separated values as RFC 4180 has them: fields with commas, quotes or line ends
 * are quoted, and quotes in them doubled.
 */

namespace tool {

/** \brief Read the next record, of several lines where a quoted field has them.
 * \param[out] record without the line end
 * \param[in,out] line that of the end of what has been read
 * \return false at the end of the stream
 */
bool
readRecord(std::istream& stream, std::string& record, std::size_t& line);

/** \brief The fields of a record.
 * \throws std::runtime_error where quotes are wrong
 */
std::vector<std::string>
fieldsOf(const std::string& record);

/** \brief A field, quoted where it has to be. */
std::string
asField(const std::string& text);

} // namespace tool
